// SPDX-License-Identifier: BSD-3-Clause
// After the rounds, cells go back to the ranks that they came from.
#include "Rounds/vtkMeshOptimizeRounds.h"

#include "Ranks/vtkMeshRanksBand.h"
#include "Ranks/vtkMeshRanksCheck.h"

#include <algorithm>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

/// A rank that would have more than this times the mean, and more than any rank has without, does
/// not get back its cells.
constexpr double MostOfMean = 1.2;

/**
 * The target of each cell that is not at home and may go there; -1: it stays.
 */
std::vector<int> FindHomes(const Ranks& ranks, const Part& part, vtkIdType cells)
{
  std::vector<vtkIdType> counts(ranks.GetCount(), 0);
  // A cell's home is that of its ancestor, so that new cells go where their parents came from.
  for (const int home : part.Home)
  {
    ++counts[home];
  }
  std::vector<Bytes> out(ranks.GetCount());
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    Put(out[r], counts[r]);
  }
  vtkIdType here = 0; // if all came home
  for (const Bytes& bytes : ranks.Exchange(std::move(out)))
  {
    here += Reader(bytes).Take<vtkIdType>();
  }
  const std::vector<vtkIdType> loads = ranks.Gather(here);
  const std::vector<vtkIdType> now = ranks.Gather(part.GetNumberOfCells());
  const double most = std::max(MostOfMean * static_cast<double>(cells) / ranks.GetCount(),
    static_cast<double>(*std::max_element(now.begin(), now.end())));
  std::vector<int> target(part.Home.size(), -1);
  for (std::size_t c = 0; c < target.size(); ++c)
  {
    const int home = part.Home[c];
    const bool isFull = static_cast<double>(loads[home]) > most;
    target[c] = home == ranks.GetRank() || isFull ? -1 : home;
  }
  return target;
}

} // namespace

// So that cells are where the caller had them, as far as ranks do not get too many.
void Rounds::SendHome()
{
  Part before;
  bool isSent = false; // `before` has what Mine had
  const std::string fault = this->All.Together(
    [&]()
    {
      const std::vector<int> target = FindHomes(this->All, this->Mine, this->Result.NumberOfCells);
      const bool goes = std::any_of(target.begin(), target.end(), [](int t) { return t >= 0; });
      // Moving is collective: all ranks take part, or none.
      if (this->All.IsAny(goes))
      {
        before = std::move(this->Mine);
        isSent = true;
        // The mesh of all ranks must be the same as before, cell by cell, wherever its cells are.
        const Signature whole = this->Present ? *this->Present
                                              : vtkMeshRanks::Sign(this->All, before, this->Normal);
        std::vector<char> isMoved;
        Move(this->All, target, this->Points, this->Cells, before, this->Mine, isMoved);
        const std::string problem = Compare(whole, this->Sign(), true);
        this->All.Agree(problem.empty() ? "" : "After cells have gone home " + problem + ".");
      }
      return std::string();
    });
  if (!fault.empty())
  {
    // All ranks go back together: the mesh is whole again, only not at home.
    if (isSent)
    {
      this->Mine = std::move(before);
    }
    this->Result.Fault = this->Result.Fault.empty() ? fault : this->Result.Fault;
  }
}

} // namespace vtkMeshOptimizeBridge
