#include "renderer/gl/open_gl.h"

#include <utility>

namespace relief {

Result<std::shared_ptr<const OpenGl>> OpenGl::create(GlPlatform platform, bool debug,
                                                     bool records) {
  std::shared_ptr<OpenGl> made(new OpenGl);
  RELIEF_TRY_ASSIGN(auto context, make_context(platform, debug));
  made->context_ = std::move(context);
  if (records) made->recorder_.emplace();
  RELIEF_TRY_ASSIGN(const auto functions,
                    load_functions(*made->context_, made->recorder_ ? &*made->recorder_ : nullptr));
  made->gl_ = functions;
  if (made->recorder_)
    made->recorder_->ask(made->gl_.GetTextureLevelParameteriv, made->gl_.GetTextureParameteriv);
  if (debug) made->log_.emplace(made->gl_);
  return std::shared_ptr<const OpenGl>(std::move(made));
}

Result<std::shared_ptr<const OpenGl>> OpenGl::adopt(const GlLoader& load) {
  std::shared_ptr<OpenGl> made(new OpenGl);
  made->context_ = adopt_context(load);
  RELIEF_TRY_ASSIGN(made->gl_, load_functions(*made->context_, nullptr));
  return std::shared_ptr<const OpenGl>(std::move(made));
}

}  // namespace relief
