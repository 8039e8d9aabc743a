// SPDX-License-Identifier: BSD-3-Clause
/**
 * TetGen's mesh as a vtkUnstructuredGrid.
 */
#ifndef vtkTetGenExport_h
#define vtkTetGenExport_h

#include "vtkTetGenJob.h"
#include "vtkTetGenSurface.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace vtkTetGenBridge
{

/**
 * First all points of `input`, with their ids, then the new ones; the cell array `Region`; point
 * data of `input`, with NaN for new points (integers: 0); field data.
 */
void ExportMesh(
  vtkPolyData* input, const Surface& surface, const Mesh& mesh, vtkUnstructuredGrid* output);

/**
 * Checks the points that mark regions (`regions`: x y z attribute volume). Returns a warning about
 * each that lies in no tetrahedron, or in a region that another point has marked.
 * O(tetrahedra * regions).
 */
std::vector<std::string> CheckRegions(const std::vector<double>& regions, const Mesh& mesh);

} // namespace vtkTetGenBridge

#endif
