// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMeshRanksExchange.h"

#include "vtkCommunicator.h"

#include <algorithm>
#include <new>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

constexpr int Tag = 71919;

void Send(vtkMultiProcessController* controller, const Bytes& bytes, int to)
{
  const vtkTypeInt64 length = static_cast<vtkTypeInt64>(bytes.size());
  controller->Send(reinterpret_cast<const char*>(&length), sizeof(length), to, Tag);
  if (length > 0)
  {
    controller->Send(bytes.data(), static_cast<vtkIdType>(length), to, Tag);
  }
}

Bytes Receive(vtkMultiProcessController* controller, int from)
{
  vtkTypeInt64 length = 0;
  controller->Receive(reinterpret_cast<char*>(&length), sizeof(length), from, Tag);
  Bytes bytes(static_cast<std::size_t>(length));
  if (length > 0)
  {
    controller->Receive(bytes.data(), static_cast<vtkIdType>(length), from, Tag);
  }
  return bytes;
}

} // namespace

Ranks::Ranks(vtkMultiProcessController* controller)
  : Controller(controller)
  , Rank(controller->GetLocalProcessId())
  , Count(controller->GetNumberOfProcesses())
{
}

std::vector<Bytes> Ranks::Exchange(std::vector<Bytes> out) const
{
  std::vector<Bytes> in(this->Count);
  in[this->Rank] = std::move(out[this->Rank]);
  int steps = 1;
  while (steps < this->Count)
  {
    steps *= 2;
  }
  // In step s all pairs (r, r xor s) meet. The lower one sends first, so that nobody waits for
  // somebody who waits for others.
  for (int s = 1; s < steps; ++s)
  {
    const int partner = this->Rank ^ s;
    if (partner >= this->Count)
    {
      continue;
    }
    if (this->Rank < partner)
    {
      Send(this->Controller, out[partner], partner);
      in[partner] = Receive(this->Controller, partner);
    }
    else
    {
      in[partner] = Receive(this->Controller, partner);
      Send(this->Controller, out[partner], partner);
    }
    Bytes().swap(out[partner]);
  }
  return in;
}

std::vector<Bytes> Ranks::Gather(const Bytes& mine) const
{
  std::vector<vtkIdType> lengths = this->Gather(static_cast<vtkIdType>(mine.size()));
  std::vector<vtkIdType> offsets(this->Count, 0);
  for (int r = 1; r < this->Count; ++r)
  {
    offsets[r] = offsets[r - 1] + lengths[r - 1];
  }
  Bytes joined(static_cast<std::size_t>(offsets.back() + lengths.back()));
  if (!joined.empty())
  {
    this->Controller->AllGatherV(
      mine.data(), joined.data(), lengths[this->Rank], lengths.data(), offsets.data());
  }
  std::vector<Bytes> all(this->Count);
  for (int r = 0; r < this->Count; ++r)
  {
    all[r].assign(joined.begin() + offsets[r], joined.begin() + offsets[r] + lengths[r]);
  }
  return all;
}

vtkIdType Ranks::Sum(vtkIdType value) const
{
  vtkIdType sum = 0;
  this->Controller->AllReduce(&value, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

bool Ranks::IsAny(bool value) const { return this->Sum(value ? 1 : 0) > 0; }

std::string Ranks::Agree(const std::string& error) const
{
  if (!this->IsAny(!error.empty()))
  {
    return {};
  }
  const std::vector<Bytes> all = this->Gather(Bytes(error.begin(), error.end()));
  const auto first = std::find_if(
    all.begin(), all.end(), [](const Bytes& text) { return !text.empty(); });
  return "Rank " + std::to_string(first - all.begin()) + ": " +
    std::string(first->begin(), first->end());
}

std::string Ranks::Together(const std::function<std::string()>& work) const
{
  std::string error;
  try
  {
    error = work();
  }
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to optimize this mesh.";
  }
  return this->Agree(error);
}

} // namespace vtkMeshRanks
