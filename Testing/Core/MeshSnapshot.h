// SPDX-License-Identifier: BSD-3-Clause
// All of a mesh and its editor, to see that what was undone is undone.
#ifndef meshopt_Testing_MeshSnapshot_h
#define meshopt_Testing_MeshSnapshot_h

#include "Mesh/MeshEditor.h"

#include <vector>

namespace meshopt
{
/// Everything but marks, and the editor's pools.
template <int D>
struct Snapshot
{
  std::vector<std::int64_t> numbers;
  std::vector<double> values;

  explicit Snapshot(MeshEditor<D>& editor)
  {
    const SimplexMesh<D>& mesh = editor.mesh();
    for (Index c = 0; c < mesh.numberOfCellSlots(); ++c)
    {
      this->add(mesh.nodes(c));
      for (int i = 0; i <= D; ++i)
      {
        this->numbers.push_back(mesh.adjacent(c, i));
        this->numbers.push_back(mesh.patch(c, i));
      }
      const auto& data = mesh.cellData(c);
      this->add(std::array<std::int64_t, 5>{
        data.region, data.parent, data.stamp, data.flags, data.level });
      this->values.push_back(data.quality);
    }
    for (Index p = 0; p < mesh.numberOfPointSlots(); ++p)
    {
      const auto& data = mesh.pointData(p);
      this->add(std::array<std::int64_t, 4>{ data.cell, data.stamp, data.owner, data.flags });
      this->values.insert(this->values.end(), data.x.data(), data.x.data() + D);
      const Place place = mesh.place(p);
      this->add(std::array<std::int64_t, 2>{ static_cast<int>(place.freedom), place.part });
      this->values.push_back(place.parameter);
    }
    this->numbers.push_back(-7);
    this->add(editor.freeCells());
    this->numbers.push_back(-8);
    this->add(editor.freePoints());
  }
  template <class List>
  void add(const List& list)
  {
    this->numbers.insert(this->numbers.end(), list.begin(), list.end());
  }
  bool operator==(const Snapshot& o) const
  {
    return this->numbers == o.numbers && this->values == o.values;
  }
};
}

#endif
