// SPDX-License-Identifier: BSD-3-Clause
// Points where parts only touch, against the components of the cells at each point.
#include "Mesh/PinchedPoints.h"
#include "TestMeshes.h"

#include <numeric>

using namespace meshopt;

namespace
{
template <class>
class PinchedPoints : public ::testing::Test
{
};
TYPED_TEST_SUITE(PinchedPoints, TestDimensions);

/// Into how many parts the cells at p fall that share facets with p.
template <int D>
int partsAt(const std::vector<Simplex<D>>& cells, Index p)
{
  std::vector<Simplex<D>> star;
  for (Simplex<D> c : cells)
  {
    if (std::find(c.begin(), c.end(), p) != c.end())
    {
      std::sort(c.begin(), c.end());
      star.push_back(c);
    }
  }
  std::vector<int> part(star.size());
  std::iota(part.begin(), part.end(), 0);
  for (std::size_t a = 0; a < star.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      std::vector<Index> common;
      std::set_intersection(
        star[a].begin(), star[a].end(), star[b].begin(), star[b].end(), std::back_inserter(common));
      if (common.size() == D)
      {
        std::replace(part.begin(), part.end(), int(part[a]), int(part[b]));
      }
    }
  }
  return static_cast<int>(std::set<int>(part.begin(), part.end()).size());
}
}

/// Grids of which cells are missing here and there.
TYPED_TEST(PinchedPoints, AreThoseOfSeveralParts)
{
  constexpr int D = TypeParam::dimension;
  int pinched = 0, single = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    TestRandom random(seed);
    MeshInput<D> in = jitteredGrid<D>(D == 2 ? 6 : 3, 0.2);
    in.cells.erase(std::remove_if(in.cells.begin(), in.cells.end(),
                     [&](const Simplex<D>&) { return random() > 0.2; }),
      in.cells.end());
    const std::vector<std::uint8_t> found = pinchedPoints<D>(buildMesh(in));
    ASSERT_EQ(found.size(), in.points.size());
    for (std::size_t p = 0; p < in.points.size(); ++p)
    {
      const bool wanted = partsAt<D>(in.cells, static_cast<Index>(p)) > 1;
      EXPECT_EQ(found[p] != 0, wanted) << seed << ": " << p;
      ++(wanted ? pinched : single);
    }
  }
  EXPECT_GT(pinched, 50);
  EXPECT_GT(single, 50);
}

TYPED_TEST(PinchedPoints, NoListWhereThereIsNone)
{
  constexpr int D = TypeParam::dimension;
  EXPECT_TRUE(pinchedPoints<D>(buildMesh(jitteredGrid<D>(3, 0.2))).empty());
  // Kept facets do not part what is connected.
  MeshInput<D> in = jitteredGrid<D>(4, 0.2);
  splitRegions(in);
  EXPECT_TRUE(pinchedPoints<D>(buildMesh(in)).empty());
  EXPECT_TRUE(pinchedPoints<D>(SimplexMesh<D>()).empty());
}
