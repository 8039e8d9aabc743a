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
 * Points of `input` first, all of them and with their ids, then the new ones; the cell array
 * `Region`; point data of `input`, new points having NaN (integers: 0); field data.
 */
void ExportMesh(
  vtkPolyData* input, const Surface& surface, const Mesh& mesh, vtkUnstructuredGrid* output);

/**
 * What became of the points that mark regions (`regions`: x y z attribute volume): a warning about
 * each that lies in no tetrahedron, or in one that another point has marked.
 * O(tetrahedra * regions).
 */
std::vector<std::string> CheckRegions(const std::vector<double>& regions, const Mesh& mesh);

} // namespace vtkTetGenBridge

#endif
