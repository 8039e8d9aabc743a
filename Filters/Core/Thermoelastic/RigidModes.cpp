// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions as a small eigenproblem: what must not move is a row, the sum of squared rows is a
// matrix, and its null space are the motions that are free.
#include "Thermoelastic/RigidModes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace meshopt::fem
{
namespace
{
/// Motions with an eigenvalue below this part of the trace violate nothing. With more constraints
/// the trace and the rounding errors are greater, by the same. A smaller part takes rounding for a
/// constraint. A larger one overlooks constraints at points near each other: with this one they are
/// up to 3e-7 of the group apart (the root, since conditions are squared).
constexpr double NoConstraint = 1e-13;
/// Of motions (columns of norm 1) smaller entries count as 0 in a message. Above what rounding
/// leaves of an eigenvector, below what a person would call a slope.
constexpr double Shown = 1e-6;
/// Of numbers that differ by less, relatively, the first one is taken, so that rounding does not
/// decide what a message says.
constexpr double SameEntries = 1e-6, SameMotions = 1e-9;

/// Displacement at r from the centre, for each of the six (2D: three) numbers of the motion. Linear
/// in them, since strains and rotations are small.
template <int D>
using MotionMatrix = Eigen::Matrix<double, D, MotionSize<D>>;

MotionMatrix<2> motionMatrix(const Vec<2>& r)
{
  // u = t + w (-y, x)
  MotionMatrix<2> m;
  m << 1, 0, -r[1], 0, 1, r[0];
  return m;
}

MotionMatrix<3> motionMatrix(const Vec<3>& r)
{
  MotionMatrix<3> m;
  // u = t + w x r
  m << 1, 0, 0, 0, r[2], -r[1], 0, 1, 0, -r[2], 0, r[0], 0, 0, 1, r[1], -r[0], 0;
  return m;
}

template <class Group, class Point>
auto motionMatrix(const Group& group, const Point& x)
{
  // In units of the group: rotations then displace about as much as translations.
  return motionMatrix(Point((x - group.centre) / group.length));
}

/// Union-find: nearly linear in the number of joins.
struct Groups
{
  std::vector<Index> parent;
  explicit Groups(Index n)
    : parent(n)
  {
    for (Index i = 0; i < n; ++i)
    {
      this->parent[i] = i;
    }
  }
  Index find(Index i)
  {
    while (this->parent[i] != i)
    {
      // Halves the path for later calls.
      i = this->parent[i] = this->parent[this->parent[i]];
    }
    return i;
  }
  /// The lower id becomes the leader, so that the result does not depend on the order.
  void join(Index i, Index j)
  {
    i = this->find(i);
    j = this->find(j);
    (i < j ? this->parent[j] : this->parent[i]) = std::min(i, j);
  }
};

/// Column echelon form that eliminates rotations first. Columns without a rotation as pivot are
/// translations; these come first in the result. Each column gets norm 1.
template <int D>
Eigen::MatrixXd nameMotions(Eigen::MatrixXd m)
{
  // The columns span the free motions, but an eigensolver mixes them at will. A person reads
  // "translates along x" and "rotates about an axis": elimination brings that back.
  const auto isRotation = [](Index row) { return row % MotionSize<D> >= D; };
  std::vector<std::uint8_t> used(m.rows(), 0);
  std::vector<std::pair<Index, Index>> order; // row and column of the pivots
  Index done = 0;
  // Rotations first: what is left without any rotation can only be translations.
  for (const bool rotations : { true, false })
  {
    while (done < m.cols())
    {
      // The greatest entry left.
      Index row = None, column = None;
      double most = Shown;
      for (Index r = 0; r < m.rows(); ++r)
      {
        for (Index c = done; c < m.cols() && !used[r] && isRotation(r) == rotations; ++c)
        {
          if (std::abs(m(r, c)) > most * (1.0 + SameEntries))
          {
            most = std::abs(m(r, c));
            row = r;
            column = c;
          }
        }
      }
      if (row == None)
      {
        break;
      }
      // As in the elimination of Gauss and Jordan, by columns: the pivot's row is cleared in all
      // others.
      used[row] = 1;
      m.col(done).swap(m.col(column));
      m.col(done) /= m(row, done);
      for (Index c = 0; c < m.cols(); ++c)
      {
        if (c != done)
        {
          m.col(c) -= m(row, c) * m.col(done);
        }
      }
      order.emplace_back(row, done++);
    }
  }
  const auto sooner = [&](const std::pair<Index, Index>& a, const std::pair<Index, Index>& b)
  { return isRotation(a.first) != isRotation(b.first) ? isRotation(b.first) : a.first < b.first; };
  std::sort(order.begin(), order.end(), sooner);
  Eigen::MatrixXd named(m.rows(), 0);
  for (const auto& pivot : order)
  {
    named.conservativeResize(m.rows(), named.cols() + 1);
    named.col(named.cols() - 1) = m.col(pivot.second).normalized();
  }
  return named;
}

/// A point that two bodies share.
struct Hinge
{
  Index point, bodyA, bodyB;
};

template <int D>
class ModeFinder
{
public:
  ModeFinder(const SimplexMesh<D>& mesh, RigidModes<D>& modes)
    : mesh_(mesh)
    , modes_(modes)
  {
  }

  /// Each step needs those before it: hinges are between bodies, groups are connected by hinges,
  /// and conditions are in the units of their group.
  void run(const std::vector<Constraint>& constraints)
  {
    this->findBodies();
    this->findHinges();
    this->findGroups();
    this->measureGroups();
    this->addConstraints(constraints);
    this->addHinges();
    this->solve();
  }

private:
  using Body = typename RigidModes<D>::Body;
  using Group = typename RigidModes<D>::Group;
  static constexpr int M = MotionSize<D>;

  /// Cells that are connected over facets. D points in common leave two cells no motion against
  /// each other; with fewer they could turn.
  void findBodies()
  {
    const Index n = this->mesh_.numberOfCellSlots();
    Groups joined(n);
    for (Index c = 0; c < n; ++c)
    {
      for (int i = 0; i <= D; ++i)
      {
        const Index other = this->mesh_.adjacent(c, i);
        if (other != None)
        {
          joined.join(c, SimplexMesh<D>::cellOf(other));
        }
      }
    }
    this->bodyOfCell_.assign(n, None);
    for (Index c = 0; c < n; ++c)
    {
      // Leaders come before their followers: bodies are numbered by their first cells.
      const Index leader = joined.find(c); // <= c
      if (leader == c)
      {
        this->bodyOfCell_[c] = static_cast<Index>(this->modes_.bodies.size());
        this->modes_.bodies.push_back({ c });
      }
      this->bodyOfCell_[c] = this->bodyOfCell_[leader];
      ++this->modes_.bodies[this->bodyOfCell_[c]].cells;
    }
  }

  /// Points in cells of several bodies. bodyOfPoint is the first of these: each other body gets a
  /// condition with it, so that all of them are joined.
  void findHinges()
  {
    std::vector<Index>& bodyOf = this->modes_.bodyOfPoint;
    bodyOf.assign(this->mesh_.numberOfPointSlots(), None);
    for (Index c = 0; c < this->mesh_.numberOfCellSlots(); ++c)
    {
      for (Index p : this->mesh_.nodes(c))
      {
        if (bodyOf[p] == None)
        {
          bodyOf[p] = this->bodyOfCell_[c];
        }
        else if (bodyOf[p] != this->bodyOfCell_[c])
        {
          // A hinge may come several times: the same condition twice leaves the same motions free.
          this->hinges_.push_back({ p, bodyOf[p], this->bodyOfCell_[c] });
        }
      }
    }
  }

  /// Bodies that are connected by hinges.
  void findGroups()
  {
    std::vector<Body>& bodies = this->modes_.bodies;
    Groups joined(static_cast<Index>(bodies.size()));
    for (const Hinge& h : this->hinges_)
    {
      joined.join(h.bodyA, h.bodyB);
    }
    std::vector<Index> sizes;
    for (Index b = 0; b < static_cast<Index>(bodies.size()); ++b)
    {
      const Index leader = joined.find(b); // <= b
      if (leader == b)
      {
        bodies[b].group = static_cast<Index>(sizes.size());
        sizes.push_back(0);
      }
      bodies[b].group = bodies[leader].group;
      bodies[b].place = sizes[bodies[b].group]++;
    }
    for (Body& body : bodies)
    {
      // Too many bodies for a dense problem: all get one place, as if they were one rigid body.
      // Conditions of hinges then cancel out in addHinges(), where i = j.
      body.place = sizes[body.group] > MostBodiesInGroup ? 0 : body.place;
    }
    this->modes_.groups.resize(sizes.size());
    for (Index size : sizes)
    {
      const Index n = size > MostBodiesInGroup ? M : M * size;
      this->normals_.push_back(Eigen::MatrixXd::Zero(n, n));
    }
  }

  /// The centre and the size of each group: the origin and the unit of length of its motions.
  void measureGroups()
  {
    std::vector<Group>& groups = this->modes_.groups;
    std::vector<Vec<D>> low(
      groups.size(), Vec<D>::Constant(std::numeric_limits<double>::infinity()));
    // There is at least one group: check() refuses a mesh without cells.
    std::vector<Vec<D>> high(groups.size(), -low.front());
    for (Index p = 0; p < this->mesh_.numberOfPointSlots(); ++p)
    {
      if (this->modes_.bodyOfPoint[p] != None)
      {
        // A hinge belongs to several bodies, but all of them are in one group.
        const Index g = this->modes_.bodies[this->modes_.bodyOfPoint[p]].group;
        low[g] = low[g].cwiseMin(this->mesh_.point(p));
        high[g] = high[g].cwiseMax(this->mesh_.point(p));
      }
    }
    // In these units constraints have entries of about 1, whatever the units of the mesh: solve()
    // can then tell zero from rounding.
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      groups[g].centre = 0.5 * (low[g] + high[g]);
      groups[g].length = 0.5 * (high[g] - low[g]).norm();
    }
  }

  /// What is held goes into the matrix of its group.
  void addConstraints(const std::vector<Constraint>& constraints)
  {
    for (const Constraint& c : constraints)
    {
      const Index b = this->modes_.bodyOfPoint[c.point];
      if (b != None)
      {
        const Body& body = this->modes_.bodies[b];
        // A constrained component must not move: its row, squared, goes into the normal matrix.
        const Eigen::Matrix<double, 1, M> row = motionMatrix(
          this->modes_.groups[body.group], this->mesh_.point(c.point))
                                                  .row(c.component);
        this->normals_[body.group].template block<M, M>(
          M * body.place, M * body.place) += row.transpose() * row;
      }
    }
  }

  /// The same for points at which two bodies are connected.
  void addHinges()
  {
    for (const Hinge& h : this->hinges_)
    {
      const Body& a = this->modes_.bodies[h.bodyA];
      const Index i = M * a.place, j = M * this->modes_.bodies[h.bodyB].place;
      // Both bodies are in one group, with one origin and unit.
      const MotionMatrix<D> m = motionMatrix(
        this->modes_.groups[a.group], this->mesh_.point(h.point));
      // At a hinge both bodies must move alike: the square of the difference of their motions.
      const Eigen::Matrix<double, M, M> block = m.transpose() * m;
      Eigen::MatrixXd& normal = this->normals_[a.group];
      normal.template block<M, M>(i, i) += block;
      normal.template block<M, M>(j, j) += block;
      normal.template block<M, M>(i, j) -= block;
      normal.template block<M, M>(j, i) -= block;
    }
  }

  /// One dense eigenproblem per group, which is small.
  void solve()
  {
    for (std::size_t g = 0; g < this->normals_.size(); ++g)
    {
      const Eigen::MatrixXd& normal = this->normals_[g];
      // Eigenvalues ascend: the null space comes first.
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(normal);
      const double tiny = NoConstraint * std::max(1.0, normal.trace());
      Index count = 0;
      while (count < normal.rows() && eigen.eigenvalues()[count] < tiny)
      {
        ++count;
      }
      this->modes_.groups[g].free = eigen.eigenvectors().leftCols(count);
      this->modes_.groups[g].named = nameMotions<D>(this->modes_.groups[g].free);
    }
  }

  const SimplexMesh<D>& mesh_;
  RigidModes<D>& modes_;
  std::vector<Index> bodyOfCell_;
  std::vector<Hinge> hinges_;
  std::vector<Eigen::MatrixXd> normals_; // per group: sum of squares of all that must be at rest
};

/// Rounded for output, without "-0".
double tidy(double x, double scale)
{
  const double unit = Shown * scale;
  const double rounded = unit * std::round(x / unit);
  return std::abs(rounded) < unit ? 0.0 : rounded;
}

template <int D>
std::string list(const Vec<D>& v, double scale)
{
  std::ostringstream text;
  for (int i = 0; i < D; ++i)
  {
    text << (i ? ", " : "(") << tidy(v[i], scale);
  }
  text << ")";
  return text.str();
}

std::string describeMotion(const Vec<2>& t, const Vec<1>& w, const Vec<2>& centre, double length)
{
  if (std::abs(w[0]) < Shown * t.norm())
  {
    return "translate along " + list<2>(t.normalized(), 1.0);
  }
  // At rest: t + w (-r_y, r_x) = 0.
  const Vec<2> r = Vec<2>(-t[1], t[0]) / w[0];
  return "rotate about the point " + list<2>(Vec<2>(centre + length * r), length);
}

std::string describeMotion(const Vec<3>& t, const Vec<3>& w, const Vec<3>& centre, double length)
{
  if (w.norm() < Shown * t.norm())
  {
    return "translate along " + list<3>(t.normalized(), 1.0);
  }
  const Vec<3> axis = w.normalized();
  // The point of the axis nearest to the centre: w x t / |w|^2.
  const Vec<3> r = Vec<3>(w[1] * t[2] - w[2] * t[1], w[2] * t[0] - w[0] * t[2],
                     w[0] * t[1] - w[1] * t[0]) /
    w.squaredNorm();
  // A screw: what goes along the axis is no part of a rotation.
  const std::string pitch = std::abs(t.dot(axis)) > Shown ? " (and translate along it)" : "";
  return "rotate about the axis through " + list<3>(Vec<3>(centre + length * r), length) +
    " along " + list<3>(axis, 1.0) + pitch;
}
}

template <int D>
Index RigidModes<D>::count() const
{
  Index n = 0;
  for (const Group& group : this->groups)
  {
    n += static_cast<Index>(group.free.cols());
  }
  return n;
}

/// Only the numbers of the body of the point count.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> RigidModes<D>::displacements(
  const SimplexMesh<D>& mesh, Index p, const Eigen::MatrixXd& motions) const
{
  constexpr int M = MotionSize<D>;
  const Body& body = this->bodies[this->bodyOfPoint[p]];
  return motionMatrix(this->groups[body.group], mesh.point(p)) *
    motions.template middleRows<M>(M * body.place);
}

/// By the body that moves most: in a mechanism others move, too, but this one shows it best.
template <int D>
std::string RigidModes<D>::describe(Index group, Index mode) const
{
  constexpr int M = MotionSize<D>;
  const Group& g = this->groups[group];
  const auto motion = [&](const Body& body)
  { return g.named.col(mode).template segment<M>(M * body.place); };
  const Body* most = nullptr; // of the group, the body that moves most
  // Linear in the bodies: this is only for a message.
  for (const Body& body : this->bodies)
  {
    if (body.group == group &&
      (!most || motion(body).squaredNorm() > motion(*most).squaredNorm() * (1.0 + SameMotions)))
    {
      most = &body;
    }
  }
  const Vec<D> t = motion(*most).template head<D>();
  const Vec<M - D> w = motion(*most).template tail<M - D>();
  const std::string who = this->bodies.size() == 1 ? "the mesh"
                                                   : "the part of the mesh that holds cell " +
      std::to_string(most->cell) + " (" + std::to_string(most->cells) + " cells)";
  return who + " can " + describeMotion(t, w, g.centre, g.length);
}

template <int D>
std::string RigidModes<D>::describe() const
{
  // The rest is counted: one free body has no more, and many loose parts are one mistake.
  constexpr Index Most = 6;
  if (this->bodies.size() == 1 && this->count() == MotionSize<D>)
  {
    return "the mesh can translate and rotate freely";
  }
  std::string text;
  Index done = 0;
  for (Index g = 0; g < static_cast<Index>(this->groups.size()); ++g)
  {
    for (Index m = 0; m < this->groups[g].named.cols(); ++m, ++done)
    {
      if (done < Most)
      {
        text += (done ? "; " : "") + this->describe(g, m);
      }
    }
  }
  return done > Most ? text + "; and " + std::to_string(done - Most) + " more" : text;
}

template <int D>
RigidModes<D> findRigidModes(const SimplexMesh<D>& mesh, const std::vector<Constraint>& constraints)
{
  RigidModes<D> modes;
  ModeFinder<D>(mesh, modes).run(constraints);
  return modes;
}

template struct RigidModes<2>;
template struct RigidModes<3>;
template RigidModes<2> findRigidModes<2>(const SimplexMesh<2>&, const std::vector<Constraint>&);
template RigidModes<3> findRigidModes<3>(const SimplexMesh<3>&, const std::vector<Constraint>&);
}
