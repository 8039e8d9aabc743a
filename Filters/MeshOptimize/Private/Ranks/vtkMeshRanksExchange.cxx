// SPDX-License-Identifier: BSD-3-Clause
// All ranks meet at each step, also those that have failed: a rank that left early would keep the
// others waiting for ever.
#include "Ranks/vtkMeshRanksExchange.h"

#include "vtkCommunicator.h"

#include <exception>
#include <new>
#include <utility>

namespace vtkMeshRanks
{
namespace
{

// No other message of a controller may be taken for one of these.
constexpr int Tag = 71919;

void Send(vtkMultiProcessController* controller, const Bytes& bytes, int to)
{
  // Empty messages are not sent: both sides know the lengths.
  if (!bytes.empty())
  {
    controller->Send(bytes.data(), static_cast<vtkIdType>(bytes.size()), to, Tag);
  }
}

void Receive(vtkMultiProcessController* controller, Bytes& bytes, int from)
{
  if (!bytes.empty())
  {
    controller->Receive(bytes.data(), static_cast<vtkIdType>(bytes.size()), from, Tag);
  }
}

/**
 * Lets all ranks send out[r] to rank r, whose in[r] has the right size already.
 */
void SwapAll(
  vtkMultiProcessController* controller, int rank, std::vector<Bytes>& out, std::vector<Bytes>& in)
{
  const int count = static_cast<int>(out.size());
  // Up to the next power of two: r xor s then meets all.
  int steps = 1;
  while (steps < count)
  {
    steps *= 2;
  }
  // In step s all pairs (r, r xor s) meet. The lower one sends first, so that nobody waits for
  // somebody who waits for others.
  for (int s = 1; s < steps; ++s)
  {
    const int partner = rank ^ s;
    if (partner >= count)
    {
      continue;
    }
    if (rank < partner)
    {
      Send(controller, out[partner], partner);
      Receive(controller, in[partner], partner);
    }
    else
    {
      Receive(controller, in[partner], partner);
      Send(controller, out[partner], partner);
    }
    // What has been sent is not needed any more: its memory is free for what comes.
    Bytes().swap(out[partner]);
  }
}

} // namespace

Ranks::Ranks(vtkMultiProcessController* controller)
  : Controller(controller)
  , Rank(controller->GetLocalProcessId())
  , Count(controller->GetNumberOfProcesses())
{
}

void Ranks::Meet(const std::string& error) const
{
  // The longest error: one reduction tells whether there is any, and it costs no more than a flag.
  vtkIdType mine = static_cast<vtkIdType>(error.size()), most = 0;
  this->Controller->AllReduce(&mine, &most, 1, vtkCommunicator::MAX_OP);
  if (most == 0)
  {
    return;
  }
  // One after another: no rank needs more memory than one sentence.
  for (int r = 0; r < this->Count; ++r)
  {
    // The rank's own length on rank r; the others are told.
    vtkIdType length = mine;
    this->Controller->Broadcast(&length, 1, r);
    if (length > 0)
    {
      std::string text = error;
      text.resize(static_cast<std::size_t>(length));
      this->Controller->Broadcast(text.data(), length, r);
      throw Failure{ "Rank " + std::to_string(r) + ": " + text };
    }
  }
}

std::vector<Bytes> Ranks::Exchange(std::vector<Bytes> out) const
{
  // Lengths first: nobody may fail for want of memory while a partner waits.
  std::vector<Bytes> lengths(this->Count), theirs(this->Count, Bytes(sizeof(vtkTypeInt64)));
  for (int r = 0; r < this->Count; ++r)
  {
    Put(lengths[r], static_cast<vtkTypeInt64>(out[r].size()));
  }
  this->Meet({});
  SwapAll(this->Controller, this->Rank, lengths, theirs);
  std::vector<Bytes> in(this->Count);
  for (int r = 0; r < this->Count; ++r)
  {
    in[r].resize(
      r == this->Rank ? 0 : static_cast<std::size_t>(Reader(theirs[r]).Take<vtkTypeInt64>()));
  }
  in[this->Rank] = std::move(out[this->Rank]);
  this->Meet({});
  SwapAll(this->Controller, this->Rank, out, in);
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
  // It may throw for want of memory: hence the meeting before anything is sent.
  Bytes joined(static_cast<std::size_t>(offsets.back() + lengths.back()));
  this->Meet({});
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

// Here a rank learns that another one has failed in the meantime.
vtkIdType Ranks::Sum(vtkIdType value) const
{
  this->Meet({});
  vtkIdType sum = 0;
  this->Controller->AllReduce(&value, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

bool Ranks::IsAny(bool value) const { return this->Sum(value ? 1 : 0) > 0; }

std::string Ranks::Together(const std::function<std::string()>& work) const
{
  std::string error;
  try
  {
    // What one rank finds wrong must end the work of all: see Meet().
    error = work();
  }
  catch (const Failure& failure) // thrown by all ranks
  {
    return failure.Error;
  }
  // A rank that has no memory left must still tell the others.
  catch (const std::bad_alloc&)
  {
    error = "Not enough memory to optimize this mesh.";
  }
  catch (const std::exception& problem)
  {
    error = problem.what();
  }
  try
  {
    this->Meet(error);
  }
  catch (const Failure& failure)
  {
    return failure.Error;
  }
  return {};
}

} // namespace vtkMeshRanks
