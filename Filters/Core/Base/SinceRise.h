// SPDX-License-Identifier: BSD-3-Clause
/// @file SinceRise.h
/// What has been spent on a quality since it last rose.
#ifndef meshopt_Base_SinceRise_h
#define meshopt_Base_SinceRise_h

#include "Base/Raised.h"

namespace meshopt
{
/// Work on the worst quality may go on as long as it rises clearly for what is spent on it.
class SinceRise
{
public:
  static constexpr double ClearRise = 0.05; ///< relatively

  /// So much more has been spent, and the quality is this now. The first one counts as a rise.
  void note(double spent, double quality)
  {
    this->spent_ += spent;
    if (quality > raised(this->risen_, ClearRise))
    {
      this->risen_ = quality;
      this->spent_ = 0.0;
    }
  }
  double spent() const { return this->spent_; }

private:
  double spent_ = 0.0;
  double risen_ = -1.0; ///< the quality when it last rose clearly; at first below all qualities
};
}

#endif
