// SPDX-License-Identifier: BSD-3-Clause
/**
 * The ranks that work on one mesh: bytes from each to each, sums in the order of the ranks, and
 * errors that all learn of.
 *
 * All functions of Ranks are collective: every rank must call them, in the same order. Each begins
 * with the question whether a rank has failed; then it throws on all ranks.
 */
#ifndef vtkMeshRanksExchange_h
#define vtkMeshRanksExchange_h

#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <cstring>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace vtkMeshRanks
{

using Bytes = std::vector<char>;

/**
 * Appends a plain value, or all of a list with its length.
 */
template <class T>
void Put(Bytes& bytes, const T& value)
{
  static_assert(std::is_trivially_copyable<T>::value, "only plain values can be sent");
  const char* first = reinterpret_cast<const char*>(&value);
  bytes.insert(bytes.end(), first, first + sizeof(T));
}

template <class T>
void PutAll(Bytes& bytes, const std::vector<T>& values)
{
  static_assert(std::is_trivially_copyable<T>::value, "only plain values can be sent");
  Put(bytes, static_cast<vtkTypeInt64>(values.size()));
  const char* first = reinterpret_cast<const char*>(values.data());
  bytes.insert(bytes.end(), first, first + values.size() * sizeof(T));
}

/**
 * Takes what Put() and PutAll() have written, in the same order. What was never written is not
 * there to be taken: IsAtEnd().
 */
class Reader
{
public:
  explicit Reader(const Bytes& bytes)
    : At(bytes.data())
    , End(bytes.data() + bytes.size())
  {
  }

  bool IsAtEnd() const { return this->At == this->End; }

  template <class T>
  T Take()
  {
    T value;
    this->TakeBytes(&value, sizeof(T));
    return value;
  }

  template <class T>
  std::vector<T> TakeAll()
  {
    std::vector<T> values(static_cast<std::size_t>(this->Take<vtkTypeInt64>()));
    this->TakeBytes(values.data(), values.size() * sizeof(T));
    return values;
  }

  void TakeBytes(void* target, std::size_t n)
  {
    if (n > 0)
    {
      std::memcpy(target, this->At, n);
      this->At += n;
    }
  }

private:
  const char* At;
  const char* End;
};

/**
 * Thrown on all ranks at once if one of them has failed. The sentence is the same on all.
 */
struct Failure
{
  std::string Error;
};

class Ranks
{
public:
  explicit Ranks(vtkMultiProcessController* controller);

  int GetRank() const { return this->Rank; }
  int GetCount() const { return this->Count; }
  bool IsFirst() const { return this->Rank == 0; }

  /**
   * Sends out[r] to rank r. Returns what came from each rank. Pairs of ranks meet one after
   * another, so that a rank needs as many steps as there are ranks, and memory for what it sends
   * and gets.
   */
  std::vector<Bytes> Exchange(std::vector<Bytes> out) const;

  /**
   * The bytes of all ranks.
   */
  std::vector<Bytes> Gather(const Bytes& mine) const;

  /**
   * One value of each rank, in the order of the ranks. What is summed in this order has the same
   * bits everywhere.
   */
  template <class T>
  std::vector<T> Gather(const T& value) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "only plain values can be sent");
    std::vector<T> all(this->Count);
    this->Meet(std::string());
    this->Controller->AllGather(reinterpret_cast<const char*>(&value),
      reinterpret_cast<char*>(all.data()), static_cast<vtkIdType>(sizeof(T)));
    return all;
  }

  vtkIdType Sum(vtkIdType value) const;
  bool IsAny(bool value) const;

  /**
   * Throws Failure with the first error of any rank, the rank named. Nothing if there is none.
   */
  void Agree(const std::string& error) const { this->Meet(error); }

  /**
   * Runs work, which returns an error or an empty string, and agrees on its error: the same on all
   * ranks. The work may call other ranks. Whatever it throws on one rank, std::bad_alloc above all,
   * ends the work of all others at the next function of Ranks that they call: nobody waits for
   * ever.
   */
  std::string Together(const std::function<std::string()>& work) const;

private:
  /// Every function begins with it: throws Failure on all ranks if one has an error.
  void Meet(const std::string& error) const;

  vtkMultiProcessController* Controller;
  int Rank, Count;
};

} // namespace vtkMeshRanks

#endif
