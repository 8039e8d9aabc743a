// SPDX-License-Identifier: BSD-3-Clause
// The audit: each kind of damage is found.
#include "TestMeshes.h"

#include <functional>

namespace meshopt
{
/// Breaks what only the mesh itself may touch.
struct MeshTestAccess
{
  template <int D>
  static auto& cell(SimplexMesh<D>& mesh, Index c)
  {
    return mesh.cells_[c];
  }
  template <int D>
  static auto& data(SimplexMesh<D>& mesh, Index c)
  {
    return mesh.cellData_[c];
  }
  template <int D>
  static auto& point(SimplexMesh<D>& mesh, Index p)
  {
    return mesh.points_[p];
  }
};
}

using namespace meshopt;

template <class T>
class MeshAudit : public ::testing::Test
{
};
TYPED_TEST_SUITE(MeshAudit, TestDimensions);

TYPED_TEST(MeshAudit, FindsWhatIsBroken)
{
  constexpr int D = TypeParam::dimension;
  using Access = MeshTestAccess;
  using M = SimplexMesh<D>;
  MeshInput<D> in = jitteredGrid<D>(4, 0.1);
  splitRegions(in);
  const M good = buildMesh(in);
  expectSound(good);
  Index c = None; // a cell without a kept facet, and its first free node
  for (Index k = 0; k < good.numberOfCellSlots() && c == None; ++k)
  {
    c = (good.cellData(k).flags & M::FacetBits) == 0 ? k : None;
  }
  Index s = None, side = 0;  // a facet at the surface
  Index r = None, rSide = 0; // one between regions
  for (Index k = 0; k < good.numberOfCellSlots(); ++k)
  {
    for (int i = 0; i <= D; ++i)
    {
      if (good.adjacent(k, i) == None)
      {
        s = k;
        side = i;
      }
      else if (good.isKept(k, i))
      {
        r = k;
        rSide = i;
      }
    }
  }
  ASSERT_TRUE(c != None && s != None && r != None);
  struct Case
  {
    const char* word;
    std::function<void(M&)> damage;
  };
  const std::vector<Case> cases = {
    { "not positive",
      [&](M& m) { std::swap(Access::cell(m, c).nodes[0], Access::cell(m, c).nodes[1]); } },
    { "dead point",
      [&](M& m) { Access::point(m, m.nodes(c)[0]).flags &= std::uint8_t(~M::PointAlive); } },
    { "dead point", [&](M& m) { Access::cell(m, c).nodes[0] = m.numberOfPointSlots(); } },
    { "dead cell", [&](M& m) { Access::data(m, c).flags = 0; } },
    { "not the facet",
      [&](M& m) { std::swap(Access::cell(m, c).adjacent[0], Access::cell(m, c).adjacent[1]); } },
    { "surface but not kept", [&](M& m) { Access::cell(m, c).adjacent[0] = None; } },
    { "surface but not kept",
      [&](M& m) { Access::data(m, s).flags &= std::uint16_t(~(1u << side)); } },
    { "one side only", [&](M& m) { Access::data(m, r).flags &= std::uint16_t(~(1u << rSide)); } },
    { "between regions", [&](M& m) { Access::data(m, c).region = 7; } },
    { "is free",
      [&](M& m) { Access::point(m, m.facet(s, side)[0]).flags &= std::uint8_t(~M::PointHeld); } },
    { "is free",
      [&](M& m)
      { Access::point(m, m.facet(s, side)[0]).flags &= std::uint8_t(~M::PointBoundary); } },
    { "does not use it", [&](M& m) { Access::point(m, m.nodes(c)[0]).cell = s; } },
  };
  for (std::size_t k = 0; k < cases.size(); ++k)
  {
    if (std::string(cases[k].word) == "does not use it" &&
      good.localIndex(s, good.nodes(c)[0]) >= 0)
    {
      continue;
    }
    M mesh = good;
    cases[k].damage(mesh);
    std::string all;
    for (const std::string& fault : mesh.audit(true))
    {
      all += fault + "\n";
    }
    EXPECT_NE(all.find(cases[k].word), std::string::npos)
      << "case " << k << ": '" << cases[k].word << "' is not in:\n"
      << all;
  }
}

TYPED_TEST(MeshAudit, FindsUnusedAndDoubleCells)
{
  constexpr int D = TypeParam::dimension;
  using M = SimplexMesh<D>;
  MeshInput<D> in = oneCell<D>();
  in.points.push_back(Vec<D>::Constant(9.0));
  M unused = buildMesh(in);
  expectSound(unused);
  MeshTestAccess::point(unused, D + 1).flags |= M::PointAlive;
  EXPECT_EQ(unused.audit(true).size(), 1u);

  const Index n = D + 1; // a copy of the cell that gets the first one's points
  for (Index p = 0; p < n; ++p)
  {
    in.points.push_back(in.points[p] + Vec<D>::Constant(3.0));
  }
  Simplex<D> copy = in.cells[0];
  for (Index& p : copy)
  {
    p += n + 1;
  }
  in.cells.push_back(copy);
  M twice = buildMesh(in);
  expectSound(twice);
  MeshTestAccess::cell(twice, 1).nodes = twice.nodes(0);
  bool found = false;
  for (const std::string& fault : twice.audit(true))
  {
    found = found || fault.find("stands twice") != std::string::npos;
  }
  EXPECT_TRUE(found);
}
