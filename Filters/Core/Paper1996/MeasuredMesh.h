// SPDX-License-Identifier: BSD-3-Clause
/// @file MeasuredMesh.h
/// What the paper's two algorithms work on.
#ifndef meshopt_Paper1996_MeasuredMesh_h
#define meshopt_Paper1996_MeasuredMesh_h

#include "Mesh/MeshEditor.h"
#include "Metric/NodalMetric.h"
#include "Quality/Measure.h"

namespace meshopt
{
/// A mesh, and how the quality of its cells is measured (2.2). The qualities must be up to date;
/// they are kept so.
template <int D>
struct MeasuredMesh
{
  MeshEditor<D>& editor;
  NodalMetric<D>& metric;
  Measure measure;
  double beta = 0.0; ///< width of the size factor, >= 0
};
}

#endif
