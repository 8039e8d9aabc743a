// SPDX-License-Identifier: BSD-3-Clause
// Data of points that were interpolated in several rounds, taken anew from the input, which only
// its first owners have. So they have been interpolated once, as on one rank.
#include "Rounds/vtkMeshOptimizeRanksSampling.h"

#include "Grid/vtkMeshOptimizeSampling.h"
#include "Grid/vtkMeshOptimizeTransfer.h"
#include "vtkMeshBridgeImport.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>

namespace vtkMeshOptimizeBridge
{

using namespace vtkMeshRanks;

namespace
{

constexpr double Far = std::numeric_limits<double>::infinity();

/**
 * The question of one rank to another: where is x?
 */
struct Question
{
  std::array<double, 3> X;
  vtkIdType Hint; ///< a cell of the other's input, or -1
};

struct Box
{
  std::array<double, 3> Low{ { Far, Far, Far } }, High{ { -Far, -Far, -Far } };

  bool Has(const double* x) const
  {
    for (int k = 0; k < 3; ++k)
    {
      if (!(this->Low[k] <= x[k] && x[k] <= this->High[k]))
      {
        return false;
      }
    }
    return true;
  }
};

/**
 * The input of this rank, which answers questions.
 */
template <int D>
class Source
{
public:
  Source(vtkUnstructuredGrid* grid, const vtkMeshBridge::Frame<D>& frame, const Schema& schema)
    : Grid(grid)
    , Frame(frame)
  {
    vtkPointData* data = grid->GetPointData();
    for (vtkAbstractArray* like : schema.Arrays)
    {
      vtkAbstractArray* array = nullptr;
      for (int i = 0; i < data->GetNumberOfArrays() && !array; ++i)
      {
        // By name, which may be missing on both sides.
        const char* a = like->GetName();
        const char* b = data->GetAbstractArray(i)->GetName();
        array = (a && b ? std::strcmp(a, b) == 0 : a == b) ? data->GetAbstractArray(i) : nullptr;
      }
      this->Arrays.emplace_back(array);
      this->Likes.emplace_back(like);
    }
  }

  Box GetBox() const
  {
    Box box;
    // Where there are no cells, nothing can be sampled: nobody is to ask.
    const vtkIdType n = this->Grid->GetNumberOfCells() > 0 ? this->Grid->GetNumberOfPoints() : 0;
    for (vtkIdType p = 0; p < n; ++p)
    {
      double x[3];
      this->Grid->GetPoint(p, x);
      for (int k = 0; k < 3; ++k)
      {
        box.Low[k] = std::min(box.Low[k], x[k]);
        box.High[k] = std::max(box.High[k], x[k]);
      }
    }
    return box;
  }

  /**
   * Distances from the input, and the values there.
   */
  Bytes Answer(const Bytes& questions)
  {
    Bytes answer;
    std::vector<double> distances;
    std::vector<Sample> samples;
    // The mesh for the search is made only if somebody asks: see GetBackground().
    for (Reader reader(questions); !reader.IsAtEnd();)
    {
      const Question question = reader.Take<Question>();
      const meshopt::Vec<D> x = this->Frame.ToCore(question.X.data());
      const meshopt::Background<D>& background = this->GetBackground();
      const auto place = background.locate(
        x, question.Hint < 0 ? meshopt::None : static_cast<meshopt::Index>(question.Hint));
      distances.push_back(place.cell == meshopt::None ? Far : place.distance);
      samples.push_back(
        place.cell == meshopt::None ? Sample() : MakeSample<D>(background, x, place));
    }
    if (samples.empty())
    {
      return answer;
    }
    PutAll(answer, distances);
    for (std::size_t a = 0; a < this->Arrays.size(); ++a)
    {
      vtkSmartPointer<vtkAbstractArray> values = MakeLike(this->Likes[a]);
      values->SetNumberOfTuples(static_cast<vtkIdType>(samples.size()));
      for (std::size_t i = 0; i < samples.size(); ++i)
      {
        const vtkIdType id = static_cast<vtkIdType>(i);
        if (auto numbers = vtkDataArray::SafeDownCast(this->Arrays[a]))
        {
          SetSample(numbers, samples[i], vtkDataArray::SafeDownCast(values), id);
        }
        // What cannot be averaged comes from the nearest corner.
        else
        {
          values->SetTuple(id, samples[i].Nearest, this->Arrays[a]);
        }
      }
      Pack(values, answer);
    }
    return answer;
  }

private:
  // Made when the first question comes: a rank may be asked nothing.
  const meshopt::Background<D>& GetBackground()
  {
    if (!this->Background)
    {
      std::vector<vtkIdType> all(this->Grid->GetNumberOfCells());
      std::iota(all.begin(), all.end(), vtkIdType(0));
      meshopt::SimplexMesh<D> mesh; // cannot fail: the piece was optimized
      meshopt::SimplexMesh<D>::build(
        vtkMeshBridge::ImportGeometry(this->Grid, all, this->Frame), mesh);
      this->Background.emplace(mesh);
    }
    return *this->Background;
  }

  vtkUnstructuredGrid* Grid;
  vtkMeshBridge::Frame<D> Frame;
  vtkMeshRanks::Arrays Arrays, Likes;
  std::optional<meshopt::Background<D>> Background;
};

/**
 * A question with all that is known of its answer.
 */
struct Search
{
  vtkIdType Point;
  bool IsNew;
  double Distance = Far;
};

/**
 * Asks each rank r for the points asked[r] (indices of `searches`), and takes over what is nearer
 * than what is known.
 */
template <int D>
void Ask(const Ranks& ranks, Source<D>& source, const std::vector<std::vector<std::size_t>>& asked,
  const std::vector<vtkIdType>& hints, const Schema& schema, std::vector<Search>& searches,
  Part& part)
{
  std::vector<Bytes> out(ranks.GetCount());
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    for (const std::size_t i : asked[r])
    {
      const double* x = part.GetPoint(searches[i].Point);
      Put(out[r], Question{ { x[0], x[1], x[2] }, hints.empty() ? -1 : hints[i] });
    }
  }
  // Two exchanges, one there and one back, whatever the number of questions.
  std::vector<Bytes> answers;
  for (const Bytes& questions : ranks.Exchange(std::move(out)))
  {
    answers.push_back(source.Answer(questions));
  }
  const std::vector<Bytes> in = ranks.Exchange(std::move(answers));
  for (int r = 0; r < ranks.GetCount(); ++r)
  {
    if (asked[r].empty())
    {
      continue;
    }
    Reader reader(in[r]);
    const std::vector<double> distances = reader.TakeAll<double>();
    std::vector<char> isNearer;
    for (std::size_t k = 0; k < asked[r].size(); ++k)
    {
      Search& search = searches[asked[r][k]];
      // Strictly nearer: of equals the first answer stays, the owner's before all others.
      isNearer.push_back(distances[k] < search.Distance);
      search.Distance = std::min(search.Distance, distances[k]);
    }
    for (std::size_t a = 0; a < part.PointArrays.size(); ++a)
    {
      vtkAbstractArray* array = part.PointArrays[a];
      const vtkSmartPointer<vtkAbstractArray> values = Unpack(reader, array);
      const bool isIdentity = schema.Attributes[a] == vtkDataSetAttributes::PEDIGREEIDS;
      for (std::size_t k = 0; k < asked[r].size(); ++k)
      {
        const Search& search = searches[asked[r][k]];
        // An identity stays with its point, however far that has moved.
        if (isNearer[k] && (search.IsNew || !isIdentity))
        {
          array->SetTuple(search.Point, static_cast<vtkIdType>(k), values);
        }
      }
    }
  }
}

template <int D>
void SampleIn(const Ranks& ranks, Source<D>& source, const std::vector<vtkIdType>& firstCell,
  const Schema& schema, vtkIdType firstNew, Part& part)
{
  std::vector<Search> searches;
  std::vector<vtkIdType> hints;
  std::vector<std::vector<std::size_t>> asked(ranks.GetCount());
  std::vector<int> owners;
  for (vtkIdType p = 0; p < part.GetNumberOfPoints(); ++p)
  {
    const vtkIdType hint = part.Hint[p];
    if (hint >= 0)
    {
      // Origins are numbered rank by rank: the last rank that begins at or before the hint has it.
      const auto owner = std::upper_bound(firstCell.begin(), firstCell.end(), hint) - 1;
      owners.push_back(static_cast<int>(owner - firstCell.begin()));
      asked[owners.back()].push_back(searches.size());
      hints.push_back(hint - *owner);
      searches.push_back({ p, part.PointIds[p] >= firstNew });
    }
  }
  Ask(ranks, source, asked, hints, schema, searches, part);
  // Those not found inside the hinted piece: whoever may have them, by the box of his input.
  const std::vector<Box> boxes = ranks.Gather(source.GetBox());
  asked.assign(ranks.GetCount(), {});
  for (std::size_t i = 0; i < searches.size(); ++i)
  {
    // Distance 0: inside. Nobody can be nearer.
    for (int r = 0; r < ranks.GetCount() && searches[i].Distance > 0.0; ++r)
    {
      if (r != owners[i] && boxes[r].Has(part.GetPoint(searches[i].Point)))
      {
        asked[r].push_back(i);
      }
    }
  }
  Ask(ranks, source, asked, {}, schema, searches, part);
}

} // namespace

//------------------------------------------------------------------------------
void SampleOnce(const Ranks& ranks, vtkUnstructuredGrid* input,
  const std::vector<vtkIdType>& firstCell, const Schema& schema, vtkIdType firstNew,
  const vtkMeshBridge::Frame<2>& plane, Part& part)
{
  if (schema.Arrays.empty())
  {
    return;
  }
  if (part.Corners == 4)
  {
    Source<3> source(input, vtkMeshBridge::Frame<3>(), schema);
    SampleIn(ranks, source, firstCell, schema, firstNew, part);
  }
  else
  {
    Source<2> source(input, plane, schema);
    SampleIn(ranks, source, firstCell, schema, firstNew, part);
  }
}

} // namespace vtkMeshOptimizeBridge
