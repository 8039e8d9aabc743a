// SPDX-License-Identifier: BSD-3-Clause
// A quality is raised by a part of its size, whatever its sign.
#include "Base/Raised.h"

#include <gtest/gtest.h>

using meshopt::raised;

TEST(Raised, RisesWhateverTheSign)
{
  EXPECT_DOUBLE_EQ(raised(0.5, 0.02), 0.51);
  EXPECT_DOUBLE_EQ(raised(-0.5, 0.02), -0.49);
  EXPECT_EQ(raised(0.0, 0.02), 1e-20) << "at least that";
  EXPECT_EQ(raised(1e-300, 0.02), 1e-20);
}
