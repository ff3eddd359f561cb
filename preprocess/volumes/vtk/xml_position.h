// Where Expat's parser is in a document.
#pragma once

#include <expat.h>

#include <cstddef>
#include <cstdint>

namespace relief {

// Expat 2.9 deprecates what returns `long`, and earlier versions have nothing else.
#if XML_MAJOR_VERSION > 2 || (XML_MAJOR_VERSION == 2 && XML_MINOR_VERSION >= 9)
inline std::uint64_t line_of(XML_Parser parser) {
  return XML_GetCurrentLineNumber64(parser);
}
/// Bytes before the current event.
inline std::size_t begin_of_event(XML_Parser parser) {
  return static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser));
}
inline std::size_t bytes_of_event(XML_Parser parser) {
  return static_cast<std::size_t>(XML_GetCurrentByteCount64(parser));
}
#else
inline std::uint64_t line_of(XML_Parser parser) {
  return XML_GetCurrentLineNumber(parser);
}
/// Bytes before the current event.
inline std::size_t begin_of_event(XML_Parser parser) {
  return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser));
}
inline std::size_t bytes_of_event(XML_Parser parser) {
  return static_cast<std::size_t>(XML_GetCurrentByteCount(parser));
}
#endif

}  // namespace relief
