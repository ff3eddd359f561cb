// The structure of VTK's XML files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/volumes/volume_source.h"

namespace relief {

/// An array, not read yet.
struct VtkArray {
  std::string name;
  std::string type;    ///< such as Float32
  std::string format;  ///< ascii, binary (which is base64) or appended
  std::string components;
  std::string offset;     ///< of appended arrays, from the document's `appended`
  std::string_view text;  ///< of other arrays: what is in the element
};

/// What a file's elements state; nothing is checked yet. Its views are into the source.
struct VtkDocument {
  std::string kind;         ///< ImageData, RectilinearGrid ...
  std::string byte_order;   ///< LittleEndian or BigEndian
  std::string header_type;  ///< of the sizes before arrays: UInt32 or UInt64
  std::string compressor;   ///< class; empty: arrays are not compressed
  std::string origin;
  std::string spacing;
  std::string direction;
  std::string extent;  ///< of the last piece
  std::size_t pieces = 0;
  std::string active_scalars;
  std::vector<VtkArray> point_data;
  std::vector<VtkArray> cell_data;
  std::vector<VtkArray> coordinates;  ///< of rectilinear grids
  std::vector<VtkArray> points;       ///< of structured grids
  std::string appended_encoding;      ///< raw or base64
  std::string_view appended;          ///< what follows the underscore; may be empty
};

/// Finds the elements and arrays of a file. Refuses document types, so that entities cannot expand.
Result<VtkDocument> parse_vtk_document(const VolumeSource& source);

}  // namespace relief
