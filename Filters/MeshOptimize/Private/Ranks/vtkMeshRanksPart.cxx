// SPDX-License-Identifier: BSD-3-Clause
// Parts of a divided mesh: taken apart, put into bytes, and made again from bytes. All arrays of
// the user go along: what comes out must not depend on the number of ranks.
#include "Ranks/vtkMeshRanksPart.h"

#include "vtkMeshBridgeArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace vtkMeshRanks
{
namespace
{

vtkSmartPointer<vtkIdList> MakeList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

/**
 * `n`: values of each id.
 */
template <class T>
std::vector<T> Chosen(const std::vector<T>& values, const std::vector<vtkIdType>& ids, int n = 1)
{
  std::vector<T> chosen;
  chosen.reserve(ids.size() * n);
  for (const vtkIdType id : ids)
  {
    chosen.insert(chosen.end(), values.begin() + id * n, values.begin() + (id + 1) * n);
  }
  return chosen;
}

void SelectAll(const Arrays& sources, const std::vector<vtkIdType>& ids, Arrays& chosen)
{
  chosen.clear();
  for (vtkAbstractArray* source : sources)
  {
    chosen.push_back(Select(source, ids));
  }
}

/**
 * Which points and cells of a part each of the parts gets into which it is divided.
 */
struct Division
{
  std::vector<std::vector<vtkIdType>> Points, Cells;
  std::vector<char> IsShared; ///< of each point: several parts get it
};

Division DivideInto(const Part& part, const std::vector<int>& target, int parts, int rest)
{
  Division division;
  division.Points.resize(parts);
  division.Cells.resize(parts);
  // Counted first: lists that double as they grow would take twice the memory.
  std::vector<std::size_t> counts(parts, 0);
  std::for_each(target.begin(), target.end(), [&](int k) { ++counts[k]; });
  for (int k = 0; k < parts; ++k)
  {
    division.Cells[k].reserve(counts[k]);
  }
  const vtkIdType n = part.GetNumberOfPoints();
  // Points on a cut belong to all parts that use them.
  std::vector<int> user(n, -1); // -1: none; -2: several parts
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    division.Cells[target[c]].push_back(c);
    for (int i = 0; i < part.Corners; ++i)
    {
      int& u = user[part.GetCell(c)[i]];
      u = u == -1 || u == target[c] ? target[c] : -2;
    }
  }
  std::vector<char> isUsed(n, 0);
  for (int k = 0; k < parts; ++k)
  {
    // Most parts of a piece get nothing: no need to look at all points for them.
    if (k != rest && division.Cells[k].empty())
    {
      continue;
    }
    std::fill(isUsed.begin(), isUsed.end(), 0);
    for (const vtkIdType c : division.Cells[k])
    {
      for (int i = 0; i < part.Corners; ++i)
      {
        isUsed[part.GetCell(c)[i]] = 1;
      }
    }
    // In the order of the part, so that ids stay ascending.
    for (vtkIdType p = 0; p < n; ++p)
    {
      if (isUsed[p] || (k == rest && user[p] == -1))
      {
        division.Points[k].push_back(p);
      }
    }
  }
  division.IsShared.resize(n);
  std::transform(
    user.begin(), user.end(), division.IsShared.begin(), [](int u) { return u == -2; });
  return division;
}

/**
 * Gives each of `parts` its values of one list, `n` of each id. The memory of a source that is
 * `consumed` is given back at once.
 */
template <class T>
void Deal(std::vector<T> Part::*list, int n, const std::vector<std::vector<vtkIdType>>& ids,
  const Part& source, Part* consumed, std::vector<Part>& parts)
{
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    parts[k].*list = Chosen(source.*list, ids[k], n);
  }
  if (consumed)
  {
    std::vector<T>().swap(consumed->*list);
  }
}

/**
 * `consumed`: `part` itself, if nobody needs it any more; or nullptr.
 */
std::vector<Part> SplitInto(
  const Part& part, Part* consumed, const std::vector<int>& target, int parts, int rest)
{
  const vtkIdType n = part.GetNumberOfPoints();
  const Division division = DivideInto(part, target, parts, rest);
  std::vector<Part> result(parts);
  // List after list: where the source is consumed, no more than one is there twice.
  Deal(&Part::Cells, part.Corners, division.Cells, part, consumed, result);
  Deal(&Part::CellIds, 1, division.Cells, part, consumed, result);
  Deal(&Part::Quality, 1, division.Cells, part, consumed, result);
  Deal(&Part::Origin, 1, division.Cells, part, consumed, result);
  Deal(&Part::Home, 1, division.Cells, part, consumed, result);
  Deal(&Part::Kept, 1, division.Cells, part, consumed, result);
  Deal(&Part::PointIds, 1, division.Points, part, consumed, result);
  Deal(&Part::Coordinates, 3, division.Points, part, consumed, result);
  Deal(&Part::Flags, 1, division.Points, part, consumed, result);
  Deal(&Part::Hint, 1, division.Points, part, consumed, result);
  std::vector<meshopt::Index> newIndex(n, -1);
  for (int k = 0; k < parts; ++k)
  {
    result[k].Corners = part.Corners;
    for (std::size_t i = 0; i < division.Points[k].size(); ++i)
    {
      const vtkIdType p = division.Points[k][i];
      newIndex[p] = static_cast<meshopt::Index>(i);
      result[k].Flags[i] |= division.IsShared[p] ? Skin : 0;
    }
    std::for_each(
      result[k].Cells.begin(), result[k].Cells.end(), [&](meshopt::Index& p) { p = newIndex[p]; });
    SelectAll(part.PointArrays, division.Points[k], result[k].PointArrays);
    SelectAll(part.CellArrays, division.Cells[k], result[k].CellArrays);
  }
  return result;
}

/**
 * VTK packs bits: eight values in a byte.
 */
vtkIdType BytesOf(vtkDataArray* array)
{
  return array->GetDataType() == VTK_BIT ? (array->GetNumberOfValues() + 7) / 8
                                         : array->GetNumberOfValues() * array->GetDataTypeSize();
}

} // namespace

//------------------------------------------------------------------------------
Schema Schema::Of(vtkDataSetAttributes* data, Qualities qualities)
{
  Schema schema;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const int attribute = data->IsArrayAnAttribute(i);
    // Array names may be missing. An empty name stands for none.
    const std::string name = array->GetName() ? array->GetName() : "";
    // Global ids are those of the part itself, and none of its cells is a ghost.
    const bool isLeftOut = qualities == Qualities::LeftOut && vtkMeshBridge::IsOfEarlierRun(array);
    if (attribute != vtkDataSetAttributes::GLOBALIDS && !isLeftOut &&
      name != vtkDataSetAttributes::GhostArrayName())
    {
      schema.Arrays.push_back(MakeLike(array));
      schema.Attributes.push_back(attribute);
    }
  }
  return schema;
}

Bytes Schema::Describe() const
{
  // The keys of information objects are left out: each rank has those of its own arrays.
  Bytes bytes;
  const auto put = [&bytes](const char* text)
  {
    const std::string name = text ? text : "";
    PutAll(bytes, Bytes(name.begin(), name.end()));
  };
  Put(bytes, static_cast<int>(this->Arrays.size()));
  // Components may have names of their own, which a join must not lose.
  for (std::size_t i = 0; i < this->Arrays.size(); ++i)
  {
    vtkAbstractArray* array = this->Arrays[i];
    put(array->GetName());
    Put(bytes, array->GetDataType());
    Put(bytes, array->GetNumberOfComponents());
    Put(bytes, this->Attributes[i]);
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      put(array->GetComponentName(k));
    }
  }
  return bytes;
}

/**
 * In the order of Describe(), with nothing but the lengths of texts between: both are this file.
 */
Schema Schema::From(Reader& reader)
{
  const auto take = [&reader]()
  {
    const Bytes text = reader.TakeAll<char>();
    return std::string(text.begin(), text.end());
  };
  Schema schema;
  const int count = reader.Take<int>();
  for (int i = 0; i < count; ++i)
  {
    const std::string name = take();
    auto array = vtkSmartPointer<vtkAbstractArray>::Take(
      vtkAbstractArray::CreateArray(reader.Take<int>()));
    array->SetName(name.empty() ? nullptr : name.c_str());
    array->SetNumberOfComponents(reader.Take<int>());
    schema.Attributes.push_back(reader.Take<int>());
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      const std::string component = take();
      if (!component.empty())
      {
        array->SetComponentName(k, component.c_str());
      }
    }
    schema.Arrays.push_back(array);
  }
  return schema;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAbstractArray> Select(
  vtkAbstractArray* source, const std::vector<vtkIdType>& ids)
{
  return vtkMeshBridge::Select(source, MakeList(ids));
}

Part MakePart(int corners, const Schema& points, const Schema& cells)
{
  Part part;
  part.Corners = corners;
  for (vtkAbstractArray* array : points.Arrays)
  {
    part.PointArrays.push_back(MakeLike(array));
  }
  for (vtkAbstractArray* array : cells.Arrays)
  {
    part.CellArrays.push_back(MakeLike(array));
  }
  return part;
}

//------------------------------------------------------------------------------
std::vector<Part> Split(const Part& part, const std::vector<int>& target, int parts, int rest)
{
  return SplitInto(part, nullptr, target, parts, rest);
}

std::vector<Part> Split(Part&& part, const std::vector<int>& target, int parts, int rest)
{
  std::vector<Part> result = SplitInto(part, &part, target, parts, rest);
  part = Part();
  return result;
}

//------------------------------------------------------------------------------
/**
 * Others, such as arrays of variants, have no fixed form as bytes.
 */
bool CanPack(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array);
}

void Pack(vtkAbstractArray* array, Bytes& bytes)
{
  Put(bytes, static_cast<vtkTypeInt64>(array->GetNumberOfTuples()));
  // Texts have lengths of their own; all other arrays are one block of memory.
  if (auto strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      const vtkStdString& text = strings->GetValue(i);
      PutAll(bytes, Bytes(text.begin(), text.end()));
    }
    return;
  }
  auto values = vtkDataArray::SafeDownCast(array);
  const char* first = static_cast<const char*>(values->GetVoidPointer(0));
  bytes.insert(bytes.end(), first, first + BytesOf(values));
}

// A schema says what comes: names and types are not sent with each part.
vtkSmartPointer<vtkAbstractArray> Unpack(Reader& reader, vtkAbstractArray* like)
{
  vtkSmartPointer<vtkAbstractArray> array = MakeLike(like);
  array->SetNumberOfTuples(reader.Take<vtkTypeInt64>());
  if (auto strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      const Bytes text = reader.TakeAll<char>();
      strings->SetValue(i, std::string(text.begin(), text.end()));
    }
    return array;
  }
  auto values = vtkDataArray::SafeDownCast(array);
  reader.TakeBytes(values->GetVoidPointer(0), static_cast<std::size_t>(BytesOf(values)));
  return array;
}

Bytes Pack(const Part& part)
{
  Bytes bytes;
  if (part.CellIds.empty())
  {
    // A part without cells has no points that anybody needs. Nothing is sent for it.
    return bytes;
  }
  PutAll(bytes, part.PointIds);
  PutAll(bytes, part.Coordinates);
  PutAll(bytes, part.Flags);
  PutAll(bytes, part.CellIds);
  PutAll(bytes, part.Cells);
  PutAll(bytes, part.Quality);
  PutAll(bytes, part.Origin);
  PutAll(bytes, part.Home);
  PutAll(bytes, part.Kept);
  PutAll(bytes, part.Hint);
  // In the same order as in Unpack(), without any marks: both sides are this file.
  for (const Arrays* arrays : { &part.PointArrays, &part.CellArrays })
  {
    for (vtkAbstractArray* array : *arrays)
    {
      Pack(array, bytes);
    }
  }
  return bytes;
}

Part Unpack(const Bytes& bytes, int corners, const Schema& points, const Schema& cells)
{
  Part part = MakePart(corners, points, cells);
  if (bytes.empty())
  {
    return part;
  }
  Reader reader(bytes);
  part.PointIds = reader.TakeAll<vtkIdType>();
  part.Coordinates = reader.TakeAll<double>();
  part.Flags = reader.TakeAll<std::uint8_t>();
  part.CellIds = reader.TakeAll<vtkIdType>();
  part.Cells = reader.TakeAll<meshopt::Index>();
  part.Quality = reader.TakeAll<double>();
  part.Origin = reader.TakeAll<vtkIdType>();
  part.Home = reader.TakeAll<int>();
  part.Kept = reader.TakeAll<char>();
  part.Hint = reader.TakeAll<vtkIdType>();
  for (Arrays* arrays : { &part.PointArrays, &part.CellArrays })
  {
    for (vtkSmartPointer<vtkAbstractArray>& array : *arrays)
    {
      array = Unpack(reader, array);
    }
  }
  return part;
}

} // namespace vtkMeshRanks
