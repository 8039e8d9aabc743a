// SPDX-License-Identifier: BSD-3-Clause
/// @file TrustRegion.h
/// The ascent that StarProblem (one node) and ClusterProblem (several) share.
///
/// A step is the best one for the linearized functions less |d|^2 / (2 tau). The trust tau follows
/// what steps really gain, beside what the linearization promised.
#ifndef meshopt_Reposition_TrustRegion_h
#define meshopt_Reposition_TrustRegion_h

namespace meshopt
{
struct TrustRegion
{
  static constexpr int Trials = 5; ///< steps tried from one place, each with less trust
  /// A step is taken if it gains this part of what was promised ...
  static constexpr double LeastShare = 0.1;
  /// ... and the trust grows if it gains this part.
  static constexpr double GoodShare = 0.7;
  static constexpr double Growth = 3.0, Shrinkage = 0.25; ///< of the trust
  /// Trust at the start, as a part of L^2: a unit gradient per length L moves a node by L / 10.
  static constexpr double FirstShare = 0.1;
  /// The same by the steps of FlatScale: a cell alone moves its node as far as it doubles it.
  static constexpr double FirstOfFlat = 1.0;
  static constexpr double Flat = 0.01; ///< elements of a lower quality count as flat
};

/// The most steps of a search for one node, where nothing else is said: it converges long before.
/// And of one for several.
inline constexpr int StarSteps = 20, ClusterSteps = 40;

/// When a search for better places ends.
struct SearchGoal
{
  double enough;     ///< the worst quality is at least this
  double gain;       ///< no step promises more than this
  int steps;         ///< this number of steps has been made
  double flat = 0.0; ///< from worst qualities below this, and above 0, a node steps by FlatScale
};

/// Raises `worst` until the goal is reached; returns what is reached. The problem has
///  - linearize(worst): at the place where it is;
///  - predict(tau): finds the step, returns the linearized minimum after it;
///  - tryStep(required): returns the worst after the step; if that is at most `required`, any such
///    value may be returned;
///  - accept(): goes there.
template <class Problem>
double ascend(Problem& problem, double worst, double tau, const SearchGoal& goal)
{
  for (int step = 0; step < goal.steps && worst < goal.enough;)
  {
    problem.linearize(worst);
    bool moved = false;
    for (int trial = 0; trial < TrustRegion::Trials && step < goal.steps && !moved; ++trial, ++step)
    {
      const double predicted = problem.predict(tau) - worst;
      if (!(predicted > goal.gain))
      {
        return worst;
      }
      // Armijo's rule (2.7), with the gain that the linearization promises as its measure.
      const double required = worst + TrustRegion::LeastShare * predicted;
      const double there = problem.tryStep(required);
      moved = there > required;
      tau *= there > worst + TrustRegion::GoodShare * predicted ? TrustRegion::Growth
        : moved                                                 ? 1.0
                                                                : TrustRegion::Shrinkage;
      if (moved)
      {
        problem.accept();
        worst = there;
      }
    }
    // After five refusals tau is down to a thousandth: what is left to gain is not worth more.
    if (!moved)
    {
      break;
    }
  }
  return worst;
}
}

#endif
