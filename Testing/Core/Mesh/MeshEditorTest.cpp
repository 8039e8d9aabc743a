// SPDX-License-Identifier: BSD-3-Clause
// Editing a mesh: cavities replaced, what they hand on, undoing, editors that own a part only.
#include "MeshEditorTesting.h"

using namespace meshopt;

template <class T>
class Editor : public ::testing::Test
{
};
TYPED_TEST_SUITE(Editor, TestDimensions);

// ---- replace ------------------------------------------------------------------------------------

TEST(Editor2D, SwapAndBack)
{
  MeshInput<2> in = jitteredGrid<2>(4, 0.1);
  SimplexMesh<2> mesh = buildMesh(in);
  MeshEditor<2> editor(mesh);
  const Index c = 9;
  int i = 0;
  while (mesh.isKept(c, i))
  {
    ++i;
  }
  const Index o = mesh.cellOf(mesh.adjacent(c, i));
  const Facet<2> f = mesh.facet(c, i);
  const Index a = mesh.nodes(c)[i], b = mesh.nodes(o)[mesh.facetOf(mesh.adjacent(c, i))];
  replaceAndCheck<2>(editor, { c, o }, { { a, f[0], b }, { b, f[1], a } }, false);
  expectSound(mesh, false);
  const std::vector<Index> back = editor.created();
  replaceAndCheck<2>(editor, back, { { f[0], f[1], a }, { f[1], f[0], b } });
  EXPECT_EQ(mesh.numberOfCellSlots(), Index(in.cells.size())); // slots are used again
}

TEST(Editor3D, TwoForThreeAndBack)
{
  MeshInput<3> in;
  in.points = { { 0, 0, -1 }, { 0, 0, 1 }, { 1, 0, 0 }, { -0.5, 0.8, 0 }, { -0.5, -0.8, 0 } };
  in.cells = { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } };
  SimplexMesh<3> mesh = buildMesh(in);
  const double volume = mesh.volume();
  MeshEditor<3> editor(mesh);
  for (int k = 0; k < 3; ++k)
  {
    std::vector<Index> cavity = k == 0 ? std::vector<Index>{ 0, 1 } : editor.created();
    replaceAndCheck<3>(editor, cavity, { { 0, 1, 2, 3 }, { 0, 1, 3, 4 }, { 0, 1, 4, 2 } });
    EXPECT_NEAR(mesh.volume(), volume, 1e-14);
    EXPECT_EQ(mesh.numberOfCellSlots(), 3);
    cavity = editor.created();
    replaceAndCheck<3>(editor, cavity, { { 2, 3, 4, 1 }, { 3, 2, 4, 0 } });
    EXPECT_EQ(mesh.countCells(), 2);
    EXPECT_NEAR(mesh.volume(), volume, 1e-14);
    EXPECT_EQ(mesh.numberOfCellSlots(), 3);
  }
}

TYPED_TEST(Editor, InsertAndContract)
{
  constexpr int D = TypeParam::dimension;
  MeshInput<D> in = jitteredGrid<D>(3, 0.1);
  splitRegions(in); // cells at the interface: kept facets and regions are handed on
  SimplexMesh<D> mesh = buildMesh(in);
  MeshEditor<D> editor(mesh);
  const auto kept = keptFacets(mesh);
  for (Index c = 0; c < Index(in.cells.size()); c += 7)
  {
    Vec<D> x = Vec<D>::Zero();
    for (Index p : mesh.nodes(c))
    {
      x += mesh.point(p) / (D + 1);
    }
    const Simplex<D> old = mesh.nodes(c);
    const Index p = editor.addPoint(x);
    EXPECT_GE(p, mesh.numberOfInputPoints());
    replaceAndCheck<D>(editor, { c }, joined<D>(mesh, { c }, p));
    EXPECT_EQ(editor.created().size(), std::size_t(D + 1));
    EXPECT_TRUE(mesh.isPointAlive(p) && mesh.isFree(p));
    std::vector<Index> star;
    EXPECT_TRUE(editor.star(p, star));
    EXPECT_EQ(star.size(), std::size_t(D + 1));
    if (c % 2 == 0)
    {
      const std::vector<Simplex<D>> one = joined<D>(mesh, star, old[0]);
      ASSERT_EQ(one.size(), 1u);
      replaceAndCheck<D>(editor, star, one);
    }
  }
  EXPECT_EQ(keptFacets(mesh), kept);
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
  EXPECT_EQ(eulerCharacteristic(mesh), 1);
}

TEST(Editor3D, ContractionBuriesAnInputPointButKeepsItsSlot)
{
  SimplexMesh<3> mesh = buildMesh(jitteredGrid<3>(2, 0.0));
  MeshEditor<3> editor(mesh);
  const Index v = 13; // the centre
  std::vector<Index> star;
  ASSERT_TRUE(editor.star(v, star));
  std::vector<Simplex<3>> cells;
  for (Index u = 0; u < 27 && cells.empty(); ++u)
  {
    bool flat = false;
    cells.clear();
    for (const Facet<3>& f : boundary<3>(mesh, star))
    {
      if (std::find(f.begin(), f.end(), u) == f.end())
      {
        const Simplex<3> cell{ f[0], f[1], f[2], u };
        const double volume = volumeOf<3>(mesh, cell);
        flat = flat || (u != v && volume <= 0.0);
        cells.push_back(cell);
      }
    }
    if (u == v || flat)
    {
      cells.clear();
    }
  }
  if (cells.empty()) // all are flat on the cube's faces: topology is what counts here
  {
    for (const Facet<3>& f : boundary<3>(mesh, star))
    {
      if (std::find(f.begin(), f.end(), 0) == f.end())
      {
        cells.push_back({ f[0], f[1], f[2], 0 });
      }
    }
  }
  replaceAndCheck<3>(editor, star, cells, false);
  expectSound(mesh, false);
  EXPECT_FALSE(mesh.isPointAlive(v));
  const Index p = editor.addPoint(Vec<3>(0.5, 0.5, 0.5));
  EXPECT_NE(p, v);
  EXPECT_EQ(mesh.point(v), Vec<3>(0.5, 0.5, 0.5));
}

TEST(Editor3D, KeptEdgesAreHandedOn)
{
  MeshInput<3> in = ringOf(4);
  in.keptEdges = { { 0, 1 }, { 2, 3 } };
  SimplexMesh<3> mesh = buildMesh(in);
  MeshEditor<3> editor(mesh);
  const Index p = editor.addPoint(Vec<3>(0.3, 0.3, 0.0));
  replaceAndCheck<3>(editor, { 0 }, joined<3>(mesh, { 0 }, p));
  int marks = 0;
  for (Index c : editor.created())
  {
    for (int e = 0; e < 6; ++e)
    {
      marks += mesh.isEdgeKeptByItself(c, e);
    }
  }
  EXPECT_EQ(marks, 4); // each of both edges in two of the four cells
}

// ---- undo ---------------------------------------------------------------------------------------

TYPED_TEST(Editor, RollbackRestoresEveryByte)
{
  constexpr int D = TypeParam::dimension;
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    MeshInput<D> in = jitteredGrid<D>(D == 3 ? 2 : 4, 0.1, seed);
    if (seed == 2)
    {
      splitRegions(in);
    }
    if (seed == 3 && D == 3)
    {
      in = jitteredGrid<D>(3, 0.1, seed);
      in.keptEdges = { { 21, 22 }, { 21, 37 } };
    }
    SimplexMesh<D> mesh = buildMesh(in);
    const auto kept = keptFacets(mesh);
    MeshEditor<D> editor(mesh);
    RandomEdits<D> edits(editor, seed);
    int rollbacks = 0;
    for (int k = 0; k < 25; ++k)
    {
      nested(editor, edits, 3, rollbacks);
      EXPECT_FALSE(editor.inTransaction());
    }
    EXPECT_GT(rollbacks, 20);
    for (int kind = 0; kind < 5; ++kind)
    {
      EXPECT_GT(edits.done[kind], 10) << "kind " << kind << " of seed " << seed;
    }
    EXPECT_EQ(keptFacets(mesh), kept);
    EXPECT_NEAR(mesh.volume(), 1.0, 1e-12);
    EXPECT_EQ(eulerCharacteristic(mesh), 1);
  }
}

TYPED_TEST(Editor, ANewEditorGoesOnWithClockAndMarks)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(2, 0.1));
  MeshEditor<D> first(mesh);
  const std::uint32_t m = first.newMark();
  first.setMark(3, m);
  first.stamp({ 0, 1 });
  first.movePoint(mesh.nodes(0)[0], mesh.point(mesh.nodes(0)[0]));
  MeshEditor<D> second(mesh);
  EXPECT_EQ(second.clock(), first.clock());
  EXPECT_GE(second.lastMark(), m);
  EXPECT_FALSE(second.isMarked(3, second.newMark()));
}

// ---- editors that own a part --------------------------------------------------------------------

TYPED_TEST(Editor, OwnersKeepToTheirPart)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.1));
  MeshEditor<D> root(mesh);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    root.setPointOwner(p, mesh.point(p)[0] < 0.6 ? 0 : 1);
  }
  MeshEditor<D> editor = MeshEditor<D>::beside(root);
  editor.setOwner(0);
  Index inner = None, edge = None, foreign = None; // cells: in the midst, at the border, not owned
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (!editor.owns(c))
    {
      foreign = c;
      continue;
    }
    bool border = false;
    for (int i = 0; i <= D; ++i)
    {
      const Index h = mesh.adjacent(c, i);
      border = border || (h != None && !editor.owns(mesh.cellOf(h)));
    }
    (border ? edge : inner) = c;
  }
  ASSERT_TRUE(inner != None && edge != None && foreign != None);
  EXPECT_TRUE(editor.isHeldUp()); // by the questions above
  editor.resetHeldUp();
  EXPECT_TRUE(editor.owns(inner));
  EXPECT_FALSE(editor.isHeldUp());
  EXPECT_FALSE(editor.owns(foreign));
  EXPECT_TRUE(editor.isHeldUp());
  EXPECT_TRUE(root.owns(foreign));

  // stars
  std::vector<Index> star, whole;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    mesh.star(p, whole);
    const bool all = std::all_of(
      whole.begin(), whole.end(), [&](Index c) { return editor.owns(c); });
    editor.resetHeldUp();
    EXPECT_EQ(editor.star(p, star), all);
    EXPECT_EQ(editor.isHeldUp(), !all);
    if (all)
    {
      std::sort(star.begin(), star.end());
      std::sort(whole.begin(), whole.end());
      EXPECT_EQ(star, whole);
    }
  }

  // no slots: refused, nothing changed
  editor.resetHeldUp();
  const Snapshot<D> before(editor);
  EXPECT_EQ(editor.addPoint(Vec<D>::Zero()), None);
  EXPECT_TRUE(editor.isHeldUp());
  EXPECT_TRUE(before == Snapshot<D>(editor));
  Vec<D> centre = Vec<D>::Zero();
  for (Index p : mesh.nodes(edge))
  {
    centre += mesh.point(p) / (D + 1);
  }
  editor.growPoints(1);
  const Index p = editor.addPoint(centre);
  ASSERT_NE(p, None);
  EXPECT_EQ(mesh.pointData(p).owner, 0);
  const std::vector<Simplex<D>> cells = joined<D>(mesh, { edge }, p);
  ASSERT_EQ(cells.size(), std::size_t(D + 1));
  const std::vector<double> qualities(D + 1, 0.5);
  editor.growCells(D - 1);
  editor.resetHeldUp();
  const Snapshot<D> full(editor);
  EXPECT_FALSE(editor.replace({ edge }, cells, qualities));
  EXPECT_TRUE(editor.isHeldUp());
  EXPECT_TRUE(full == Snapshot<D>(editor));

  // enough slots: only links of foreign cells change, and an undo brings those back
  editor.growCells(1);
  editor.resetHeldUp();
  const Snapshot<D> start(editor);
  const SimplexMesh<D> copy = mesh;
  const std::size_t place = editor.begin();
  ASSERT_TRUE(editor.replace({ edge }, cells, qualities));
  expectSound(mesh);
  EXPECT_EQ(mesh.numberOfCellSlots(), copy.numberOfCellSlots());
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (copy.isAlive(c) && !root.owns(c))
    {
      EXPECT_EQ(mesh.nodes(c), copy.nodes(c));
      EXPECT_EQ(mesh.cellData(c).mark, copy.cellData(c).mark);
      EXPECT_EQ(mesh.cellData(c).flags, copy.cellData(c).flags);
    }
  }
  editor.rollback(place);
  EXPECT_TRUE(start == Snapshot<D>(editor));
}

// Other threads read owners: to write the same value again would be a race, too.
TYPED_TEST(Editor, UndoDoesNotWriteTheOwner)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(2, 0.1));
  MeshEditor<D> editor(mesh);
  const Vec<D> x = mesh.point(0);
  const std::size_t place = editor.begin();
  editor.movePoint(0, x + Vec<D>::Constant(0.01));
  editor.setPointOwner(0, 7);
  editor.rollback(place);
  EXPECT_EQ(mesh.point(0), x);
  EXPECT_EQ(mesh.pointData(0).owner, 7);
}

/// An undo must not put back what another editor has changed meanwhile across the border.
TYPED_TEST(Editor, UndoLeavesTheOtherOwnersWorkAlone)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(4, 0.1));
  MeshEditor<D> root(mesh);
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    root.setPointOwner(p, mesh.point(p)[0] < 0.6 ? 0 : 1);
  }
  MeshEditor<D> left = MeshEditor<D>::beside(root), right = MeshEditor<D>::beside(root);
  left.setOwner(0);
  right.setOwner(1);
  left.growCells(100);
  right.growCells(100);
  left.growPoints(40);
  right.growPoints(40);
  const auto insertAll = [&](MeshEditor<D>& editor, int every)
  {
    const Index n = mesh.numberOfInputCells();
    for (Index c = 0, k = 0; c < n; ++c)
    {
      if (!mesh.isAlive(c) || !editor.owns(c) || k++ % every != 0 ||
        editor.freeCells().size() < std::size_t(D) || editor.freePoints().empty())
      {
        continue;
      }
      Vec<D> x = Vec<D>::Zero();
      for (Index p : mesh.nodes(c))
      {
        x += mesh.point(p) / (D + 1);
      }
      const Index p = editor.addPoint(x);
      replaceAndCheck<D>(editor, { c }, joined<D>(mesh, { c }, p), false);
    }
  };
  const std::size_t place = left.begin();
  insertAll(left, 2);
  insertAll(right, 3); // while the transaction of the other is open
  const Index after = mesh.countCells();
  expectSound(mesh);
  left.rollback(place);
  EXPECT_LT(mesh.countCells(), after);
  EXPECT_GT(mesh.countCells(), mesh.numberOfInputCells());
  expectSound(mesh);
  EXPECT_NEAR(mesh.volume(), 1.0, 1e-13);
}
