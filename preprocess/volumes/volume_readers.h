// The readers of volumes, one a format.
#pragma once

#include "common/volume/scalar_volume.h"
#include "preprocess/volumes/raw_layout.h"
#include "preprocess/volumes/volume_source.h"

namespace relief {

/// Each reader returns a volume as ScalarVolume promises, with values that are finite or NaN. On
/// any bytes, a reader never crashes or hangs, or takes memory out of proportion to the file. It
/// fails with one sentence that begins with the file's name.

/// Reads NRRD 1 to 5, attached or detached: raw, gzip, ascii. Anatomical spaces become
/// right-anterior-superior; other coordinates stay.
Result<ScalarVolume> read_nrrd(const VolumeSource& source);

/// Reads NIfTI-1 as one file (.nii), plain or gzipped. Placed by its sform, otherwise by its qform;
/// without both by its spacing, and then without anatomy.
Result<ScalarVolume> read_nifti(const VolumeSource& source);

/// Reads MetaImage: values in the same file (LOCAL) or in one other, raw, zlib-compressed or ASCII.
/// Coordinates are left-posterior-superior, as ITK has them, and become right-anterior-superior.
Result<ScalarVolume> read_meta_image(const VolumeSource& source);

/// Reads VTK's XML files of image data, rectilinear grids and structured grids of one piece: point
/// data, the active scalars or the first array of one component. Coordinates stay.
Result<ScalarVolume> read_vtk_xml(const VolumeSource& source);

/// Reads values without a header: plain, gzipped (.gz) or the single file of a zip archive (.zip).
Result<ScalarVolume> read_headerless(const VolumeSource& source, const RawLayout& layout);

}  // namespace relief
