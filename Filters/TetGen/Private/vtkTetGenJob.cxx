// SPDX-License-Identifier: BSD-3-Clause
// The only file that calls TetGen.
#include "vtkTetGenJob.h"

#include <tetgen.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace vtkTetGenBridge
{

namespace
{

/**
 * TetGen's structure owns its arrays and deletes them, with delete[]: nothing else may make them.
 */
double* NewArray(const std::vector<double>& values)
{
  double* array = new double[values.size()];
  std::copy(values.begin(), values.end(), array);
  return array;
}

/**
 * Fills TetGen's own structure, which deletes its arrays itself. Facet markers are triangle indices
 * counted from 1, since 0 means "no marker".
 */
void FillSurface(const Job& job, tetgenio& in)
{
  in.numberofpoints = static_cast<int>(job.Points.size() / 3);
  in.pointlist = NewArray(job.Points);
  in.numberoffacets = static_cast<int>(job.Triangles.size() / 3);
  in.facetlist = new tetgenio::facet[in.numberoffacets];
  in.facetmarkerlist = new int[in.numberoffacets];
  for (int f = 0; f < in.numberoffacets; ++f)
  {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    // TetGen's facets may consist of several polygons; here each is one triangle.
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy_n(job.Triangles.begin() + 3 * f, 3, facet.polygonlist[0].vertexlist);
    in.facetmarkerlist[f] = f + 1;
  }
}

void FillSeeds(const Job& job, tetgenio& in)
{
  if (!job.Holes.empty())
  {
    in.numberofholes = static_cast<int>(job.Holes.size() / 3);
    in.holelist = NewArray(job.Holes);
  }
  if (!job.Regions.empty())
  {
    in.numberofregions = static_cast<int>(job.Regions.size() / 5);
    in.regionlist = NewArray(job.Regions);
    for (int r = 0; r < in.numberofregions; ++r)
    {
      double& volume = in.regionlist[5 * r + 4];
      volume = volume > 0.0 ? volume : -1.0; // TetGen's "no limit"
    }
  }
}

bool HasRegionVolumes(const Job& job)
{
  for (std::size_t i = 4; i < job.Regions.size(); i += 5)
  {
    if (job.Regions[i] > 0.0)
    {
      return true;
    }
  }
  return false;
}

/**
 * Switches go through TetGen's parser, which derives further values from them. Numbers are set
 * afterwards, since the parser would truncate them.
 */
void FillBehavior(const Job& job, tetgenbehavior& behavior)
{
  std::string switches = "pzJA"; // a surface; count from 0; keep all points; regions as attribute
  const bool byVolume = job.MaximumVolume > 0.0;
  const bool byRegion = HasRegionVolumes(job);
  const bool byShape = job.MaximumRadiusEdgeRatio > 0.0 || job.MinimumDihedralAngle > 0.0;
  // Intersections only; surface kept; limits on shapes; volumes of all and of regions; points
  // inside.
  switches += job.OnlyFindIntersections ? "d" : "";
  switches += job.KeepSurface ? "Y" : "";
  switches += byShape || byVolume || byRegion ? "q" : "";
  switches += byVolume ? "a1" : "";
  switches += byRegion ? "a" : "";
  switches += job.InteriorPoints.empty() ? "" : "i";
  switches += "O" + std::to_string(job.OptimizationLevel);
  // A string of its own, since TetGen takes it as changeable.
  behavior.parse_commandline(&switches[0]);

  behavior.maxvolume = byVolume ? job.MaximumVolume : -1.0;
  // Without a limit on shapes (0) TetGen would still use its own default.
  behavior.minratio = job.MaximumRadiusEdgeRatio > 0.0 ? job.MaximumRadiusEdgeRatio : 1e30;
  behavior.mindihedral = job.MinimumDihedralAngle;
  // Level 0 switches off flips, smoothing and splitting; the parser would raise it if there are
  // points.
  behavior.optlevel = job.OptimizationLevel;
}

/**
 * Points of the surface stay first, even unused ones, so that they keep their numbers. Other points
 * are removed if no tetrahedron uses them (interior points that lie on the surface).
 */
void Collect(const Job& job, const tetgenio& out, Mesh& mesh)
{
  const int kept = static_cast<int>(job.Points.size() / 3);
  std::vector<int> number(out.numberofpoints, -1);
  // Which points tetrahedra use; then all that stay get their numbers.
  const int corners = 4 * out.numberoftetrahedra;
  for (int i = 0; i < corners; ++i)
  {
    number[out.tetrahedronlist[i]] = 0;
  }
  int next = 0;
  for (int p = 0; p < out.numberofpoints; ++p)
  {
    if (p < kept || number[p] == 0)
    {
      number[p] = next++;
      mesh.Points.insert(mesh.Points.end(), out.pointlist + 3 * p, out.pointlist + 3 * p + 3);
    }
  }
  for (int t = 0; t < out.numberoftetrahedra; ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      mesh.Tetrahedra.push_back(number[out.tetrahedronlist[4 * t + i]]);
    }
    // TetGen's attributes are doubles; those of region points are whole numbers, as checked.
    const double* attributes = out.tetrahedronattributelist;
    mesh.Regions.push_back(
      attributes ? static_cast<int>(attributes[t * out.numberoftetrahedronattributes]) : 1);
  }
}

} // namespace

int RunTetGen(const Job& job, Mesh& mesh)
{
  // In the child: the application's own sequence of rand() is not touched.
  std::srand(1); // TetGen uses rand(): the same mesh every time
  tetgenio in, out, interior;
  FillSurface(job, in);
  FillSeeds(job, in);
  if (!job.InteriorPoints.empty())
  {
    interior.numberofpoints = static_cast<int>(job.InteriorPoints.size() / 3);
    interior.pointlist = NewArray(job.InteriorPoints);
  }
  tetgenbehavior behavior;
  FillBehavior(job, behavior);
  try
  {
    tetrahedralize(&behavior, &in, &out, job.InteriorPoints.empty() ? nullptr : &interior);
  }
  catch (int error)
  {
    // TetGen throws its error numbers.
    return error;
  }
  Collect(job, out, mesh);
  return 0;
}

} // namespace vtkTetGenBridge
