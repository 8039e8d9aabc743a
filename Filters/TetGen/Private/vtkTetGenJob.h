// SPDX-License-Identifier: BSD-3-Clause
/**
 * One run of TetGen: input and output as plain arrays. The only place that includes tetgen.h.
 */
#ifndef vtkTetGenJob_h
#define vtkTetGenJob_h

#include <vector>

namespace vtkTetGenBridge
{

/**
 * The input of TetGen. Points, triangles and so on are flat: x y z x y z ...
 */
struct Job
{
  std::vector<double> Points; ///< of the surface, three numbers each, all used by a triangle
  std::vector<int> Triangles; ///< three indices into Points each
  std::vector<double> InteriorPoints;  ///< nodes wanted inside, three numbers each
  std::vector<double> Regions;         ///< x, y, z, attribute, greatest volume (0: no limit)
  std::vector<double> Holes;           ///< x, y, z
  double MaximumVolume = 0.0;          ///< 0: no limit
  double MaximumRadiusEdgeRatio = 0.0; ///< 0: no limit
  double MinimumDihedralAngle = 0.0;   ///< degrees; 0: no limit
  bool KeepSurface = true;
  int OptimizationLevel = 0;
  /// Only look for triangles that intersect; TetGen prints the pairs.
  bool OnlyFindIntersections = false;
};

/**
 * A mesh. The points of the surface come first, in the order of Job::Points, then those that TetGen
 * has added and that a tetrahedron uses.
 */
struct Mesh
{
  std::vector<double> Points;
  std::vector<int> Tetrahedra; ///< four indices each, in VTK's order, which is TetGen's
  std::vector<int> Regions;    ///< one per tetrahedron
};

/**
 * Runs TetGen in this process. Returns 0, or TetGen's error number. TetGen 1.5 does not fail
 * cleanly: it prints, and after most errors it frees its memory twice or an assertion ends the
 * process. Therefore call this only in a child, see RunInChild().
 */
int RunTetGen(const Job& job, Mesh& mesh);

} // namespace vtkTetGenBridge

#endif
