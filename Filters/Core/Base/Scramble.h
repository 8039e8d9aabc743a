// SPDX-License-Identifier: BSD-3-Clause
/// @file Scramble.h
/// Numbers that look random and are the same on each machine.
#ifndef meshopt_Base_Scramble_h
#define meshopt_Base_Scramble_h

#include <cstdint>
#include <cstring>

namespace meshopt
{
/// A fixed pseudo-random number for each k (splitmix64).
inline std::uint64_t scramble(std::uint64_t k)
{
  k += 0x9e3779b97f4a7c15ull;
  k = (k ^ (k >> 30)) * 0xbf58476d1ce4e5b9ull;
  k = (k ^ (k >> 27)) * 0x94d049bb133111ebull;
  return k ^ (k >> 31);
}

/// Adds the bits of x to a hash: 0 and -0 give different ones.
inline std::uint64_t addToHash(std::uint64_t hash, double x)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof(bits));
  return scramble(hash ^ bits);
}
}

#endif
