// SPDX-License-Identifier: BSD-3-Clause
// What is attached to points follows them, and is undone with them.
#include "Mesh/PointAttachment.h"
#include "MeshSnapshot.h"
#include "Metric/AttachedMetric.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// Remembers where each point was placed last, from where, and how often that was said.
template <int D>
class LastPlace final : public PointAttachment<D>
{
public:
  struct Value
  {
    Vec<D> x = Vec<D>::Zero();
    Index near = None;
    int times = 0;
    bool operator==(const Value& o) const
    {
      return this->x == o.x && this->near == o.near && this->times == o.times;
    }
  };

  std::unique_ptr<typename PointAttachment<D>::Journal> makeJournal() override
  {
    ++this->journals;
    return std::make_unique<ValueJournal<D, LastPlace, Value>>(*this);
  }
  void reserve(Index n) override
  {
    this->values.resize(std::max<std::size_t>(this->values.size(), n));
  }
  void pointPlaced(Index p, const Vec<D>& x, Index near) override
  {
    this->values[p] = { x, near, this->values[p].times + 1 };
  }
  Value get(Index p) const { return this->values[p]; }
  void set(Index p, const Value& value) { this->values[p] = value; }

  std::vector<Value> values;
  int journals = 0;
};

template <int D>
struct Attached
{
  Attached()
    : mesh(buildMesh(jitteredGrid<D>(3, 0.2)))
    , editor(mesh)
  {
    this->editor.attach(this->attachment);
  }
  Index freePoint() const
  {
    Index p = 0;
    while (!this->mesh.isFree(p))
    {
      ++p;
    }
    return p;
  }

  SimplexMesh<D> mesh;
  MeshEditor<D> editor;
  LastPlace<D> attachment;
};
}

template <class T>
class AttachmentOf : public ::testing::Test
{
};
TYPED_TEST_SUITE(AttachmentOf, TestDimensions);

TYPED_TEST(AttachmentOf, IsToldOfEachPlace)
{
  constexpr int D = TypeParam::dimension;
  Attached<D> a;
  ASSERT_EQ(a.attachment.values.size(), std::size_t(a.mesh.numberOfPointSlots()));
  const Index p = a.freePoint();
  const Vec<D> x = a.mesh.point(p) + Vec<D>::Constant(0.01);
  a.editor.movePoint(p, x);
  EXPECT_TRUE((a.attachment.values[p] == typename LastPlace<D>::Value{ x, p, 1 }));
  const Index q = a.editor.addPoint(x);
  ASSERT_EQ(a.attachment.values.size(), std::size_t(a.mesh.numberOfPointSlots())); // it has room
  a.editor.movePoint(q, x, p);
  EXPECT_TRUE((a.attachment.values[q] == typename LastPlace<D>::Value{ x, p, 1 }));
  for (Index other = 0; other < q; ++other)
  {
    EXPECT_EQ(a.attachment.values[other].times, other == p);
  }
}

/// Random moves and new points in transactions within transactions. Each is undone or kept; a copy
/// made at its beginning says what must be there after it is undone.
TYPED_TEST(AttachmentOf, IsToldOfANewPointAtOnce)
{
  constexpr int D = TypeParam::dimension;
  Attached<D> a;
  const Index p = a.freePoint();
  const Vec<D> x = a.mesh.point(p) + Vec<D>::Constant(0.01);
  const Index q = a.editor.addPoint(x, p);
  EXPECT_EQ(a.mesh.point(q), x);
  EXPECT_TRUE((a.attachment.values[q] == typename LastPlace<D>::Value{ x, p, 1 }));
  EXPECT_FALSE(a.mesh.place(q).mayMove());
  const Index slides = a.editor.addPoint(x, p, { Freedom::Curve, 3, 0.25 });
  EXPECT_TRUE((a.attachment.values[slides] == typename LastPlace<D>::Value{ x, p, 1 }));
  EXPECT_EQ(a.mesh.place(slides).freedom, Freedom::Curve);
  EXPECT_EQ(a.mesh.place(slides).part, 3);
  EXPECT_EQ(a.mesh.place(slides).parameter, 0.25);
}

TYPED_TEST(AttachmentOf, IsUndoneWithThePoints)
{
  constexpr int D = TypeParam::dimension;
  Attached<D> a;
  TestRandom random(11);
  const std::function<void(int)> transaction = [&](int depth)
  {
    const std::vector<typename LastPlace<D>::Value> values = a.attachment.values;
    const Snapshot<D> before(a.editor);
    const std::size_t place = a.editor.begin();
    for (int k = 0; k < 6; ++k)
    {
      const Index p = static_cast<Index>(0.499 * (random() + 1.0) * a.mesh.numberOfPointSlots());
      const Vec<D> x = a.mesh.point(p) + 0.01 * random() * Vec<D>::Ones();
      if (k % 3 == 2 && depth < 4)
      {
        transaction(depth + 1);
      }
      else if (k % 3 == 1)
      {
        a.editor.movePoint(a.editor.addPoint(x), x, p);
      }
      else
      {
        a.editor.movePoint(p, x);
      }
    }
    if (random() < 0.3)
    {
      a.editor.commit(place);
      return;
    }
    a.editor.rollback(place);
    EXPECT_TRUE(Snapshot<D>(a.editor) == before);
    for (std::size_t p = 0; p < values.size(); ++p)
    {
      EXPECT_TRUE(a.attachment.values[p] == values[p]) << "point " << p << ", depth " << depth;
    }
  };
  for (int k = 0; k < 20; ++k)
  {
    transaction(0);
  }
}

TYPED_TEST(AttachmentOf, EachEditorHasAJournalOfItsOwn)
{
  constexpr int D = TypeParam::dimension;
  Attached<D> a;
  MeshEditor<D> beside = MeshEditor<D>::beside(a.editor);
  EXPECT_EQ(a.attachment.journals, 2);
  std::vector<Index> inside;
  for (Index p = 0; p < a.mesh.numberOfPointSlots() && inside.size() < 2; ++p)
  {
    if (a.mesh.isFree(p))
    {
      inside.push_back(p);
    }
  }
  const Vec<D> x = a.mesh.point(inside[0]), y = a.mesh.point(inside[1]);
  const Vec<D> by = Vec<D>::Constant(0.01);
  const std::size_t one = a.editor.begin(), other = beside.begin();
  a.editor.movePoint(inside[0], x + by);
  beside.movePoint(inside[1], y + by);
  a.editor.rollback(one); // takes back what it has done, no more
  EXPECT_EQ(a.attachment.values[inside[0]].times, 0);
  EXPECT_EQ(a.attachment.values[inside[1]].times, 1);
  beside.rollback(other);
  EXPECT_EQ(a.attachment.values[inside[1]].times, 0);
  EXPECT_EQ(a.mesh.point(inside[1]), y);
}

TYPED_TEST(AttachmentOf, HearsNothingOnceDetached)
{
  constexpr int D = TypeParam::dimension;
  Attached<D> a;
  LastPlace<D> second;
  a.editor.attach(second);
  const Index p = a.freePoint();
  const Vec<D> x = a.mesh.point(p);
  a.editor.detach(a.attachment);
  const std::size_t place = a.editor.begin();
  a.editor.movePoint(p, x + Vec<D>::Constant(0.01));
  EXPECT_EQ(a.attachment.values[p].times, 0);
  EXPECT_EQ(second.values[p].times, 1); // the other one stays
  a.editor.rollback(place);
  EXPECT_EQ(second.values[p].times, 0);
}

/// The metric is the attachment that there is: a moved point has that of its new place.
TYPED_TEST(AttachmentOf, TheMetricFollowsAndIsUndone)
{
  constexpr int D = TypeParam::dimension;
  SimplexMesh<D> mesh = buildMesh(jitteredGrid<D>(3, 0.1));
  std::vector<double> sizes;
  for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
  {
    sizes.push_back(0.5 + 0.25 * mesh.point(p)[0]);
  }
  NodalMetric<D> metric;
  ASSERT_EQ(metric.set(mesh, sizes, {}), "");
  MeshEditor<D> editor(mesh);
  AttachedMetric<D> attached(metric);
  editor.attach(attached);
  const auto sizeAt = [&](Index p)
  {
    Simplex<D> alone;
    alone.fill(p);
    return metric.element(alone).desiredSize;
  };
  for (Index p = 0; p < mesh.numberOfInputPoints(); ++p)
  {
    if (!mesh.isFree(p))
    {
      continue;
    }
    const double before = sizeAt(p);
    EXPECT_NEAR(before, 0.5 + 0.25 * mesh.point(p)[0], 1e-12);
    Vec<D> x = mesh.point(p);
    x[0] += 0.02;
    const std::size_t place = editor.begin();
    editor.movePoint(p, x);
    EXPECT_GT(sizeAt(p), before);
    EXPECT_LT(sizeAt(p), before + 0.25 * 0.04);
    editor.rollback(place);
    EXPECT_EQ(sizeAt(p), before); // the bits
  }
  editor.detach(attached);
}
