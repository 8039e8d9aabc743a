// SPDX-License-Identifier: BSD-3-Clause
// CGAL's tetrahedral remeshing with the boundary kept, for peers.py: a program of its own, since
// CGAL's remeshing is GPL.
//
//   cgal_remesh IN.mesh OUT.mesh [rounds]
//
// Medit files. The edge length aimed at is the mean over the cells of IN.mesh. Prints the seconds
// of the remeshing.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/File_medit.h>
#include <CGAL/Tetrahedral_remeshing/Remeshing_triangulation_3.h>
#include <CGAL/tetrahedral_remeshing.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Tetrahedral_remeshing::Remeshing_triangulation_3<Kernel>;

/// Mean edge length, each edge counted once per cell of the body.
double meanEdge(const Triangulation& mesh)
{
  double sum = 0.0;
  long count = 0;
  for (auto cell : mesh.finite_cell_handles())
  {
    for (int i = 0; i < 4 && cell->subdomain_index() != 0; ++i)
    {
      for (int j = 0; j < i; ++j, ++count)
      {
        sum += std::sqrt(
          CGAL::squared_distance(cell->vertex(i)->point(), cell->vertex(j)->point()));
      }
    }
  }
  return sum / static_cast<double>(count);
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "cgal_remesh IN.mesh OUT.mesh [rounds]\n";
    return EXIT_FAILURE;
  }
  Triangulation mesh;
  std::ifstream in(argv[1]);
  if (!in || !CGAL::IO::read_MEDIT(in, mesh))
  {
    std::cerr << argv[1] << " cannot be read\n";
    return EXIT_FAILURE;
  }
  const auto start = std::chrono::steady_clock::now();
  CGAL::tetrahedral_isotropic_remeshing(mesh, meanEdge(mesh),
    CGAL::parameters::number_of_iterations(argc > 3 ? std::atoi(argv[3]) : 5)
      .remesh_boundaries(false));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::ostringstream text;
  text.precision(17);
  CGAL::IO::write_MEDIT(text, mesh);
  // CGAL says "MeshVersionFormatted 1", which readers take for single precision
  const std::string body = text.str();
  std::ofstream out(argv[2]);
  out << "MeshVersionFormatted 2" << body.substr(body.find('\n'));
  std::cout << "seconds " << seconds.count() << "\n";
  return out ? EXIT_SUCCESS : EXIT_FAILURE;
}
