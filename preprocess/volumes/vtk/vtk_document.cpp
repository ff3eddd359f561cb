#include "preprocess/volumes/vtk/vtk_document.h"

#include <expat.h>

#include <algorithm>
#include <memory>
#include <new>

#include "preprocess/volumes/vtk/xml_position.h"

namespace relief {
namespace {

/// XML that is parsed between two looks at whether to stop.
constexpr std::size_t kXmlStep = std::size_t{1} << 22U;
constexpr std::string_view kXmlBlanks = " \t\r\n";
constexpr std::string_view kAppendedTag = "<AppendedData";

struct FreeParser {
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
using Parser = std::unique_ptr<XML_ParserStruct, FreeParser>;

/// The attributes of an element, as expat passes them: names and values in turns, then null.
class XmlAttributes {
 public:
  explicit XmlAttributes(const XML_Char** attributes) : attributes_(attributes) {}

  /// Returns the value of an attribute; empty if there is none.
  [[nodiscard]] std::string operator[](std::string_view name) const {
    for (const XML_Char** at = attributes_; *at != nullptr; at += 2) {
      if (name == at[0]) return at[1];
    }
    return {};
  }

 private:
  const XML_Char** attributes_;
};

/// Fills a document from the events of the parser.
class VtkHandler {
 public:
  VtkHandler(XML_Parser parser, std::string_view text) : parser_(parser), text_(text) {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, on_start, on_end);
    XML_SetStartDoctypeDeclHandler(parser, on_doctype);
  }
  VtkHandler(const VtkHandler&) = delete;
  VtkHandler& operator=(const VtkHandler&) = delete;
  ~VtkHandler() = default;

  VtkDocument document;
  bool has_doctype = false;
  bool is_out_of_memory = false;

 private:
  // No exception may pass through expat, which is C.
  static void on_start(void* self, const XML_Char* name, const XML_Char** attributes) noexcept {
    auto& handler = *static_cast<VtkHandler*>(self);
    try {
      handler.start(name, XmlAttributes(attributes));
    } catch (const std::bad_alloc&) {
      handler.is_out_of_memory = true;
      XML_StopParser(handler.parser_, XML_FALSE);
    }
  }
  static void on_end(void* self, const XML_Char* name) noexcept {
    static_cast<VtkHandler*>(self)->end(name);
  }
  static void on_doctype(void* self, const XML_Char* /*name*/, const XML_Char* /*system*/,
                         const XML_Char* /*public_id*/, int /*has_internal*/) noexcept {
    auto& handler = *static_cast<VtkHandler*>(self);
    handler.has_doctype = true;
    XML_StopParser(handler.parser_, XML_FALSE);
  }

  void start(std::string_view name, const XmlAttributes& attributes) {
    if (array_ != nullptr) {  // an InformationKey, before or after the values
      close_array_text();
      return;
    }
    if (name == "DataArray" && section_ != nullptr) {
      section_->push_back({attributes["Name"],
                           attributes["type"],
                           attributes["format"],
                           attributes["NumberOfComponents"],
                           attributes["offset"],
                           {}});
      array_ = &section_->back();
      text_begin_ = begin_of_event(parser_) + bytes_of_event(parser_);
    } else if (name == "VTKFile") {
      document.kind = attributes["type"];
      document.byte_order = attributes["byte_order"];
      document.header_type = attributes["header_type"];
      document.compressor = attributes["compressor"];
    } else if (name == document.kind) {
      document.origin = attributes["Origin"];
      document.spacing = attributes["Spacing"];
      document.direction = attributes["Direction"];
    } else if (name == "Piece") {
      ++document.pieces;
      document.extent = attributes["Extent"];
    } else if (name == "PointData") {
      document.active_scalars = attributes["Scalars"];
      section_ = &document.point_data;
    } else if (name == "CellData") {
      section_ = &document.cell_data;
    } else if (name == "Coordinates") {
      section_ = &document.coordinates;
    } else if (name == "Points") {
      section_ = &document.points;
    } else if (name == "AppendedData") {
      document.appended_encoding = attributes["encoding"];
    }
  }

  void end(std::string_view name) {
    if (array_ != nullptr) {
      if (name == "DataArray") {
        close_array_text();
        array_ = nullptr;
      } else {
        text_begin_ = begin_of_event(parser_) + bytes_of_event(parser_);
      }
    } else if (name == "PointData" || name == "CellData" || name == "Coordinates" ||
               name == "Points") {
      section_ = nullptr;
    }
  }

  /// Keeps the text before the current event as the array's, unless it is blank.
  void close_array_text() {
    const std::size_t end = std::min(begin_of_event(parser_), text_.size());
    if (!array_->text.empty() || text_begin_ >= end) return;
    const std::string_view text = text_.substr(text_begin_, end - text_begin_);
    if (text.find_first_not_of(kXmlBlanks) != text.npos) array_->text = text;
  }

  XML_Parser parser_;
  std::string_view text_;
  std::vector<VtkArray>* section_ = nullptr;  ///< whose arrays are kept; null: none
  VtkArray* array_ = nullptr;                 ///< within which the parser is
  std::size_t text_begin_ = 0;
};

/// Where the XML ends that can be parsed: appended data may be any bytes.
std::size_t end_of_xml(std::string_view text) {
  const std::size_t tag = text.find(kAppendedTag);
  if (tag == text.npos) return text.size();
  const std::size_t end = text.find('>', tag);
  return end == text.npos ? text.size() : end + 1;
}

/// What follows the underscore that begins appended data.
std::string_view appended_data(std::string_view after_xml) {
  const std::size_t begin = after_xml.find_first_not_of(kXmlBlanks);
  if (begin == after_xml.npos || after_xml[begin] != '_') return {};
  return after_xml.substr(begin + 1);
}

Error xml_error(const std::string& name, XML_Parser parser, const VtkHandler& handler) {
  if (handler.is_out_of_memory || XML_GetErrorCode(parser) == XML_ERROR_NO_MEMORY)
    return make_error("{}: not enough memory to read it; free some memory", name);
  if (handler.has_doctype) {
    return make_error("{}: line {}: has a document type, which VTK files do not have; remove it",
                      name, line_of(parser));
  }
  return make_error("{}: line {}: is not XML as VTK writes it ({})", name, line_of(parser),
                    XML_ErrorString(XML_GetErrorCode(parser)));
}

}  // namespace

Result<VtkDocument> parse_vtk_document(const VolumeSource& source) {
  const std::string_view text = source.text();
  const std::size_t end = end_of_xml(text);
  const Parser parser(XML_ParserCreate(nullptr));
  if (parser == nullptr)
    return make_error("{}: not enough memory to read it; free some memory", source.name);
  VtkHandler handler(parser.get(), text);
  const bool is_whole = end == text.size();
  std::size_t at = 0;
  do {
    if (source.progress.cancelled()) return interrupted_error();
    const std::size_t step = std::min(kXmlStep, end - at);
    const bool is_last = is_whole && at + step == end;
    if (XML_Parse(parser.get(), text.data() + at, static_cast<int>(step),
                  is_last ? XML_TRUE : XML_FALSE) != XML_STATUS_OK) {
      return xml_error(source.name, parser.get(), handler);
    }
    at += step;
  } while (at < end);
  handler.document.appended = appended_data(text.substr(end));
  return std::move(handler.document);
}

}  // namespace relief
