// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshRanksPart.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace vtkMeshRanks
{
namespace
{

/**
 * An array without tuples that has the name, type, components and information of another.
 */
vtkSmartPointer<vtkAbstractArray> MakeLike(vtkAbstractArray* source)
{
  auto array = vtkSmartPointer<vtkAbstractArray>::Take(
    vtkAbstractArray::CreateArray(source->GetDataType()));
  array->SetName(source->GetName());
  array->SetNumberOfComponents(source->GetNumberOfComponents());
  array->CopyComponentNames(source);
  if (source->HasInformation())
  {
    array->CopyInformation(source->GetInformation(), 1);
  }
  return array;
}

vtkSmartPointer<vtkIdList> MakeList(const std::vector<vtkIdType>& ids)
{
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->begin());
  return list;
}

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
 * The part with these points and cells of another; `newIndex` maps points.
 */
Part Extract(const Part& part, const std::vector<vtkIdType>& points,
  const std::vector<vtkIdType>& cells, const std::vector<vtkIdType>& newIndex)
{
  Part result;
  result.Corners = part.Corners;
  result.PointIds = Chosen(part.PointIds, points);
  result.Coordinates = Chosen(part.Coordinates, points, 3);
  result.Flags = Chosen(part.Flags, points);
  result.CellIds = Chosen(part.CellIds, cells);
  result.Cells = Chosen(part.Cells, cells, part.Corners);
  result.Quality = Chosen(part.Quality, cells);
  result.Home = Chosen(part.Home, cells);
  for (vtkIdType& p : result.Cells)
  {
    p = newIndex[p];
  }
  SelectAll(part.PointArrays, points, result.PointArrays);
  SelectAll(part.CellArrays, cells, result.CellArrays);
  return result;
}

/**
 * Where a tuple of a joined array comes from.
 */
struct Origin
{
  vtkIdType Id;
  int Part;
  vtkIdType Index;
  bool operator<(const Origin& other) const
  {
    return this->Id != other.Id ? this->Id < other.Id : this->Part < other.Part;
  }
};

std::vector<Origin> ListOrigins(const std::vector<Part>& parts, std::vector<vtkIdType> Part::*ids)
{
  std::vector<Origin> origins;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    const std::vector<vtkIdType>& list = parts[k].*ids;
    for (std::size_t i = 0; i < list.size(); ++i)
    {
      origins.push_back({ list[i], static_cast<int>(k), static_cast<vtkIdType>(i) });
    }
  }
  std::sort(origins.begin(), origins.end());
  return origins;
}

/**
 * Arrays whose tuple i is that of origins[i].
 */
void Collect(const std::vector<Part>& parts, const std::vector<Origin>& origins,
  Arrays Part::*arrays, Arrays& result)
{
  std::vector<vtkNew<vtkIdList>> from(parts.size()), to(parts.size());
  for (std::size_t i = 0; i < origins.size(); ++i)
  {
    from[origins[i].Part]->InsertNextId(origins[i].Index);
    to[origins[i].Part]->InsertNextId(static_cast<vtkIdType>(i));
  }
  result.clear();
  for (std::size_t a = 0; a < (parts[0].*arrays).size(); ++a)
  {
    vtkSmartPointer<vtkAbstractArray> array = MakeLike((parts[0].*arrays)[a]);
    array->SetNumberOfTuples(static_cast<vtkIdType>(origins.size()));
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      if (from[k]->GetNumberOfIds() > 0)
      {
        array->InsertTuples(to[k], from[k], (parts[k].*arrays)[a]);
      }
    }
    result.push_back(array);
  }
}

/**
 * Joins the points; newIndex[k][i] is where point i of part k is in the result.
 */
std::string JoinPoints(
  const std::vector<Part>& parts, Part& result, std::vector<std::vector<vtkIdType>>& newIndex)
{
  std::vector<Origin> origins;
  for (const Part& part : parts)
  {
    newIndex.emplace_back(part.PointIds.size());
  }
  for (const Origin& o : ListOrigins(parts, &Part::PointIds))
  {
    const Part& part = parts[o.Part];
    const double* x = part.GetPoint(o.Index);
    if (origins.empty() || origins.back().Id != o.Id)
    {
      origins.push_back(o);
      result.PointIds.push_back(o.Id);
      result.Coordinates.insert(result.Coordinates.end(), x, x + 3);
      result.Flags.push_back(0);
    }
    else if (std::memcmp(&result.Coordinates[result.Coordinates.size() - 3], x, 3 * sizeof(double)))
    {
      return "Point " + std::to_string(o.Id) + " is at two places.";
    }
    result.Flags.back() |= part.Flags[o.Index];
    newIndex[o.Part][o.Index] = result.GetNumberOfPoints() - 1;
  }
  Collect(parts, origins, &Part::PointArrays, result.PointArrays);
  return {};
}

std::string JoinCells(
  const std::vector<Part>& parts, const std::vector<std::vector<vtkIdType>>& newIndex, Part& result)
{
  const std::vector<Origin> origins = ListOrigins(parts, &Part::CellIds);
  for (const Origin& o : origins)
  {
    const Part& part = parts[o.Part];
    if (!result.CellIds.empty() && result.CellIds.back() == o.Id)
    {
      return "Cell " + std::to_string(o.Id) + " was there twice.";
    }
    result.CellIds.push_back(o.Id);
    for (int i = 0; i < part.Corners; ++i)
    {
      result.Cells.push_back(newIndex[o.Part][part.GetCell(o.Index)[i]]);
    }
    result.Quality.push_back(part.Quality[o.Index]);
    result.Home.push_back(part.Home[o.Index]);
  }
  Collect(parts, origins, &Part::CellArrays, result.CellArrays);
  return {};
}

vtkIdType BytesOf(vtkDataArray* array)
{
  return array->GetDataType() == VTK_BIT ? (array->GetNumberOfValues() + 7) / 8
                                         : array->GetNumberOfValues() * array->GetDataTypeSize();
}

void Pack(vtkAbstractArray* array, Bytes& bytes)
{
  Put(bytes, static_cast<vtkTypeInt64>(array->GetNumberOfTuples()));
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

} // namespace

//------------------------------------------------------------------------------
Schema Schema::Of(vtkDataSetAttributes* data, const char* without)
{
  Schema schema;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const int attribute = data->IsArrayAnAttribute(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    if (attribute != vtkDataSetAttributes::GLOBALIDS && name != without &&
      name != vtkDataSetAttributes::GhostArrayName())
    {
      schema.Arrays.push_back(MakeLike(array));
      schema.Attributes.push_back(attribute);
    }
  }
  return schema;
}

std::string Schema::Describe() const
{
  std::string text;
  for (vtkAbstractArray* array : this->Arrays)
  {
    text += std::string(array->GetName() ? array->GetName() : "") + "," +
      std::to_string(array->GetDataType()) + "," + std::to_string(array->GetNumberOfComponents()) +
      ";";
  }
  return text;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAbstractArray> Select(
  vtkAbstractArray* source, const std::vector<vtkIdType>& ids)
{
  vtkSmartPointer<vtkAbstractArray> array = MakeLike(source);
  array->SetNumberOfTuples(static_cast<vtkIdType>(ids.size()));
  source->GetTuples(MakeList(ids), array);
  return array;
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
  const vtkIdType n = part.GetNumberOfPoints();
  std::vector<std::vector<vtkIdType>> cells(parts);
  std::vector<int> user(n, -1); // -1: none; -2: several parts
  for (vtkIdType c = 0; c < part.GetNumberOfCells(); ++c)
  {
    cells[target[c]].push_back(c);
    for (int i = 0; i < part.Corners; ++i)
    {
      int& u = user[part.GetCell(c)[i]];
      u = u == -1 || u == target[c] ? target[c] : -2;
    }
  }
  Part marked = part; // arrays are shared
  std::vector<char> isUsed(n, 0);
  for (vtkIdType p = 0; p < n; ++p)
  {
    marked.Flags[p] |= user[p] == -2 ? Skin : 0;
  }
  std::vector<Part> result;
  std::vector<vtkIdType> newIndex(n, -1);
  for (int k = 0; k < parts; ++k)
  {
    if (k != rest && cells[k].empty())
    {
      result.push_back(Extract(marked, {}, {}, newIndex));
      continue;
    }
    std::fill(isUsed.begin(), isUsed.end(), 0);
    for (const vtkIdType c : cells[k])
    {
      for (int i = 0; i < part.Corners; ++i)
      {
        isUsed[part.GetCell(c)[i]] = 1;
      }
    }
    std::vector<vtkIdType> points;
    for (vtkIdType p = 0; p < n; ++p)
    {
      if (isUsed[p] || (k == rest && user[p] == -1))
      {
        newIndex[p] = static_cast<vtkIdType>(points.size());
        points.push_back(p);
      }
    }
    result.push_back(Extract(marked, points, cells[k], newIndex));
  }
  return result;
}

std::string Join(const std::vector<Part>& parts, Part& result)
{
  result = Part();
  result.Corners = parts[0].Corners;
  std::vector<std::vector<vtkIdType>> newIndex;
  const std::string error = JoinPoints(parts, result, newIndex);
  return error.empty() ? JoinCells(parts, newIndex, result) : error;
}

//------------------------------------------------------------------------------
bool CanPack(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array);
}

Bytes Pack(const Part& part)
{
  Bytes bytes;
  if (part.CellIds.empty())
  {
    return bytes;
  }
  PutAll(bytes, part.PointIds);
  PutAll(bytes, part.Coordinates);
  PutAll(bytes, part.Flags);
  PutAll(bytes, part.CellIds);
  PutAll(bytes, part.Cells);
  PutAll(bytes, part.Quality);
  PutAll(bytes, part.Home);
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
  part.Cells = reader.TakeAll<vtkIdType>();
  part.Quality = reader.TakeAll<double>();
  part.Home = reader.TakeAll<int>();
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
