// SPDX-License-Identifier: BSD-3-Clause
// The queue of the worst cell against sorting all cells again each time.
#include "Paper1996/WorstQueue.h"
#include "Mesh/MeshEditor.h"
#include "TestMeshes.h"

using namespace meshopt;

namespace
{
/// A strip of n triangles that share no point: cells that can be taken away one by one.
SimplexMesh<2> apart(int n)
{
  MeshInput<2> in;
  for (int k = 0; k < n; ++k)
  {
    const Index p = static_cast<Index>(in.points.size());
    in.points.insert(in.points.end(), { Vec<2>(2 * k, 0), Vec<2>(2 * k + 1, 0), Vec<2>(2 * k, 1) });
    in.cells.push_back({ p, p + 1, p + 2 });
  }
  return buildMesh(in);
}

template <class Eligible>
Index leastOfAll(const SimplexMesh<2>& mesh, double limit, Eligible&& eligible)
{
  std::vector<std::pair<double, Index>> all;
  for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
  {
    if (mesh.isAlive(c) && mesh.quality(c) < limit && eligible(c))
    {
      all.emplace_back(mesh.quality(c), c);
    }
  }
  return all.empty() ? None : std::min_element(all.begin(), all.end())->second;
}

const auto everyCell = [](Index) { return true; };
}

TEST(WorstQueue, TiesGoToTheLowestId)
{
  SimplexMesh<2> mesh = apart(5);
  MeshEditor<2> editor(mesh);
  const double q[] = { 0.5, 0.2, 0.7, 0.2, 0.2 };
  for (Index c = 0; c < 5; ++c)
  {
    editor.setQuality(c, q[c]);
  }
  WorstQueue<2> queue(mesh, 1.0);
  queue.fill();
  EXPECT_EQ(queue.worst(everyCell), 1);
  EXPECT_EQ(queue.worst(everyCell), 1) << "it stays in the queue";
  EXPECT_EQ(queue.worst([](Index c) { return c != 1; }), 3);
  EXPECT_EQ(queue.worst([](Index c) { return c == 0 || c == 2; }), 0);
}

TEST(WorstQueue, WhatIsNotUnderTheLimitIsNotThere)
{
  SimplexMesh<2> mesh = apart(3);
  MeshEditor<2> editor(mesh);
  editor.setQuality(0, 0.6);
  editor.setQuality(1, 0.5);
  editor.setQuality(2, 0.5);
  WorstQueue<2> queue(mesh, 0.5);
  queue.fill();
  EXPECT_EQ(queue.worst(everyCell), None);
  editor.setQuality(2, std::nextafter(0.5, 0.0));
  queue.push(2);
  EXPECT_EQ(queue.worst(everyCell), 2);
}

TEST(WorstQueue, ACellThatWasNotEligibleComesBackWhenPushed)
{
  SimplexMesh<2> mesh = apart(4);
  MeshEditor<2> editor(mesh);
  for (Index c = 0; c < 4; ++c)
  {
    editor.setQuality(c, 0.1 * (c + 1));
  }
  WorstQueue<2> queue(mesh, 1.0);
  queue.fill();
  EXPECT_EQ(queue.worst([](Index c) { return c == 3; }), 3);
  queue.push(1);
  EXPECT_EQ(queue.worst([](Index c) { return c > 0; }), 1);
  queue.push(0);
  queue.push(0);
  EXPECT_EQ(queue.worst(everyCell), 0);
}

/// Qualities change, cells go and come, and become eligible and not.
TEST(WorstQueue, EqualsSortingThroughRandomChanges)
{
  constexpr double limit = 0.8;
  SimplexMesh<2> mesh = apart(40);
  MeshEditor<2> editor(mesh);
  TestRandom random(7);
  const auto quality = [&] { return std::floor(10.0 * random()) / 10.0; }; // many ties
  const auto any = [&](Index n) { return static_cast<Index>(0.4999 * (random() + 1.0) * n); };
  for (Index c = 0; c < 40; ++c)
  {
    editor.setQuality(c, quality());
  }
  WorstQueue<2> queue(mesh, limit);
  queue.fill();
  std::vector<char> eligible(200, 1);
  const auto isEligible = [&](Index c) { return eligible[c] != 0; };
  int found = 0, gone = 0;
  for (int step = 0; step < 3000; ++step)
  {
    const Index c = any(mesh.numberOfCellSlots());
    if (!mesh.isAlive(c))
    {
      continue;
    }
    const double kind = random();
    if (kind > 0.9)
    {
      // The cell becomes another one, of a slot that may have been another's.
      const Simplex<2> n = mesh.nodes(c);
      ASSERT_TRUE(editor.replace({ c }, { { n[1], n[2], n[0] } }, { quality() }));
      queue.push(editor.created()[0]);
      ++gone;
    }
    else if (kind > 0.2)
    {
      editor.setQuality(c, quality());
      queue.push(c);
    }
    else if (kind > -0.4)
    {
      eligible[c] = !eligible[c];
      queue.push(c);
    }
    const Index wanted = leastOfAll(mesh, limit, isEligible);
    ASSERT_EQ(queue.worst(isEligible), wanted) << step;
    found += wanted != None;
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(gone, 50);
}

TEST(WorstQueue, FillForgetsWhatWasThere)
{
  SimplexMesh<2> mesh = apart(3);
  MeshEditor<2> editor(mesh);
  for (Index c = 0; c < 3; ++c)
  {
    editor.setQuality(c, 0.1 * (c + 1));
  }
  WorstQueue<2> queue(mesh, 1.0);
  queue.fill();
  EXPECT_EQ(queue.worst([](Index) { return false; }), None); // all are dropped
  EXPECT_EQ(queue.worst(everyCell), None);
  queue.fill();
  EXPECT_EQ(queue.worst(everyCell), 0);
}
