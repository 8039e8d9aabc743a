// SPDX-License-Identifier: BSD-3-Clause
// The 2-3 flip against all flips that there are, and the 3-2 flip that takes it back.
#include "Operations/FaceRemoval.h"
#include "Mesh/Ids.h"
#include "Operations/EdgeRemoval.h"
#include "TestBench.h"

using namespace meshopt;

namespace
{
using Shape3 = MeanEdgeShape<3>;
constexpr double Never = -std::numeric_limits<double>::infinity();

/// The cell on the other side of the facet opposite to node a of cell t, found by its points.
Index across(const SimplexMesh<3>& mesh, Index t, Index a)
{
  for (Index o = 0; o < mesh.numberOfCellSlots(); ++o)
  {
    int shared = 0;
    for (Index p : mesh.nodes(t))
    {
      shared += p != a && hasId(mesh.nodes(o), p);
    }
    if (o != t && mesh.isAlive(o) && shared == 3)
    {
      return o;
    }
  }
  return None;
}

/// The three cells of the flip: t with each node of the face replaced by the node across.
std::vector<Simplex<3>> flipped(const SimplexMesh<3>& mesh, Index t, Index a, Index b)
{
  std::vector<Simplex<3>> cells;
  for (Index p : mesh.nodes(t))
  {
    if (p != a)
    {
      cells.push_back(exchanged(mesh.nodes(t), p, b));
    }
  }
  return cells;
}

std::set<std::set<Index>> asSets(const std::vector<Simplex<3>>& cells)
{
  std::set<std::set<Index>> sets;
  for (const Simplex<3>& c : cells)
  {
    sets.insert({ c.begin(), c.end() });
  }
  return sets;
}

/// Two flat tetrahedra on one triangle: the edge between their apexes is short.
MeshInput<3> bipyramid(double height)
{
  MeshInput<3> in = ringOf(3);
  in.points[0][2] = -height;
  in.points[1][2] = height;
  in.cells = { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  return in;
}

/// `wanted`: the cells count as so bad that any flip pays, even one whose cells are inverted.
template <class Shape>
void equalsAllFlips(unsigned seed, bool wanted, int& pays, int& refused)
{
  Bench<3, Shape> b(jitteredGrid<3>(3, 0.3, seed));
  for (Index c = 0; c < b.mesh.numberOfCellSlots() && wanted; ++c)
  {
    b.editor.setQuality(c, -10.0 - 0.1 * (c % 7));
  }
  FaceRemoval<Shape> removal;
  for (Index t = 0; t < b.mesh.numberOfCellSlots(); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Index a = b.mesh.nodes(t)[i], o = across(b.mesh, t, a);
      double expected = Never;
      std::vector<Simplex<3>> cells;
      if (o != None)
      {
        const double old = std::min(b.mesh.quality(t), b.mesh.quality(o));
        const Index opposite = *std::find_if(b.mesh.nodes(o).begin(), b.mesh.nodes(o).end(),
          [&](Index p) { return !hasId(b.mesh.nodes(t), p); });
        cells = flipped(b.mesh, t, a, opposite);
        double worst = 1.0;
        for (const Simplex<3>& cell : cells)
        {
          worst = std::min(worst, b.model(cell));
        }
        expected = worst > old ? worst : Never;
      }
      const double q = removal.propose(b.editor, b.model, t, i, Never);
      if (expected == Never)
      {
        ++refused;
        EXPECT_EQ(q, Never) << t << " " << i;
        continue;
      }
      ++pays;
      EXPECT_NEAR(q, expected, 1e-13);
      EXPECT_EQ(asSets(removal.cells()), asSets(cells));
      EXPECT_EQ(removal.oldWorst(), std::min(b.mesh.quality(t), b.mesh.quality(o)));
      EXPECT_EQ(removal.cavity(), (std::vector<Index>{ t, o }));
      EXPECT_EQ(removal.propose(b.editor, b.model, t, i, q), Never); // no better than what is asked
      EXPECT_EQ(removal.propose(b.editor, b.model, t, i, std::nextafter(q, Never)), q);
    }
  }
}
}

TEST(FaceRemoval, FindsWhatTheEnumerationFinds)
{
  for (bool wanted : { false, true })
  {
    int pays = 0, refused = 0;
    for (unsigned seed = 1; seed <= 3; ++seed)
    {
      equalsAllFlips<Shape3>(seed, wanted, pays, refused);
    }
    equalsAllFlips<MinimumSineShape<3>>(5, wanted, pays, refused);
    // 27 boxes of 6 cells have 648 facets, 108 of them at the surface
    EXPECT_TRUE(!wanted || pays == 4 * (648 - 108)) << pays;
    EXPECT_TRUE(!wanted || refused == 4 * 108) << refused;
    EXPECT_EQ(pays + refused, 4 * 648);
  }
}

TEST(FaceRemoval, IsTakenBackByEdgeRemoval)
{
  Bench<3> b(bipyramid(0.4));
  const std::vector<Simplex<3>> before{ b.mesh.nodes(0), b.mesh.nodes(1) };
  FaceRemoval<Shape3> removal;
  Proposal<3> p;
  p.newWorst = removal.propose(b.editor, b.model, 0, b.mesh.localIndex(0, 1), Never);
  // all three are the same: the edge of .8, four of hypot(1, .4), and one of sqrt(3)
  EXPECT_NEAR(p.newWorst,
    Shape3::value(
      { Vec<3>(0, 0, -0.4), Vec<3>(0, 0, 0.4), Vec<3>(1, 0, 0), Vec<3>(-0.5, std::sqrt(0.75), 0) }),
    1e-14);
  p.cavity = removal.cavity();
  p.cells = removal.cells();
  doUndoAndDo(b, [&] { return b.judge.accept(p); });
  ASSERT_EQ(b.mesh.countCells(), 3);
  EXPECT_EQ(b.worst(), p.newWorst);

  const Index t = b.editor.created()[0];
  for (Index c : b.editor.created())
  {
    b.editor.setQuality(c, -1.0); // so that the way back is wanted
  }
  EdgeRemoval<3, Shape3> back;
  EXPECT_GT(back.propose(b.editor, b.model, t, localEdge(b.mesh, t, 0, 1), Never), 0.0);
  std::vector<Simplex<3>> cells;
  back.cells(cells);
  EXPECT_EQ(asSets(cells), asSets(before));
}

TEST(FaceRemoval, NoPositiveCellsWhereTheEdgeMissesTheFace)
{
  MeshInput<3> in = bipyramid(0.4);
  in.points[0] += Vec<3>(2, 0, 0); // the line between the apexes leaves the face
  Bench<3> b(in);
  FaceRemoval<Shape3> removal;
  EXPECT_EQ(removal.propose(b.editor, b.model, 0, b.mesh.localIndex(0, 1), 0.0), Never);
  b.editor.setQuality(0, -1.0);
  b.editor.setQuality(1, -1.0);
  EXPECT_LT(removal.propose(b.editor, b.model, 0, b.mesh.localIndex(0, 1), Never), 0.0);
}

TEST(FaceRemoval, KeptFacesStay)
{
  FaceRemoval<Shape3> removal;
  const auto proposed = [&](const MeshInput<3>& in, bool away = false)
  {
    Bench<3> b(in);
    if (away)
    {
      b.giveAway({ 0 });
    }
    const Snapshot<3> before(b.editor);
    const double q = removal.propose(b.editor, b.model, 0, b.mesh.localIndex(0, 1), Never);
    EXPECT_TRUE(Snapshot<3>(b.editor) == before);
    return q;
  };
  MeshInput<3> in = bipyramid(0.4);
  EXPECT_GT(proposed(in), 0.0);
  EXPECT_EQ(proposed(in, true), Never); // the other cell is another worker's
  in.keptFacets = { { 2, 3, 4 } };
  EXPECT_EQ(proposed(in), Never);
  in.keptFacets.clear();
  in.regions = { 0, 1 };
  EXPECT_EQ(proposed(in), Never);
  in = bipyramid(0.4);
  in.cells.pop_back();
  EXPECT_EQ(proposed(in), Never); // the surface
}
