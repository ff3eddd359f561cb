#include "renderer/gl/open_gl.h"

#include <utility>

namespace relief {

Result<std::shared_ptr<const OpenGl>> OpenGl::create(GlPlatform platform, bool debug,
                                                     bool records) {
  std::shared_ptr<OpenGl> made(new OpenGl);
  auto context = make_context(platform, debug);
  if (!context) return context.error();
  made->context_ = std::move(*context);
  if (records) made->recorder_.emplace();
  const auto functions =
      load_functions(*made->context_, made->recorder_ ? &*made->recorder_ : nullptr);
  if (!functions) return functions.error();
  made->gl_ = *functions;
  if (made->recorder_) made->recorder_->ask(made->gl_);
  if (debug) made->log_.emplace(made->gl_);
  return std::shared_ptr<const OpenGl>(std::move(made));
}

}  // namespace relief
