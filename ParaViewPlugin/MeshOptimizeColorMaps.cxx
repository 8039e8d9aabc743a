// SPDX-License-Identifier: BSD-3-Clause
#include "MeshOptimizeColorMaps.h"

#include "vtkSMSettings.h"

#include <locale>
#include <sstream>

namespace
{

struct ColorMap
{
  const char* Array;
  const char* Title;
  double Bad;  // everything under it is loud
  double Most; // of the regular element
};

// .3: where the demo and the guide begin to call an element bad. 18 degrees: what Delaunay
// refinement promises at most.
const ColorMap ColorMaps[] = { { "MeshQuality", "Mesh quality", 0.3, 1.0 },
  { "MinimumDihedralAngle", "Minimum dihedral angle (degrees)", 18.0, 70.528779365509308 } };

struct Color
{
  double Place; // 0 to 1: up to Bad; 1 to 2: from there to Most
  double Red, Green, Blue;
};

const Color Colors[] = { { 0.0, 0.50, 0.00, 0.15 }, { 1.0 / 3.0, 0.80, 0.10, 0.11 },
  { 2.0 / 3.0, 0.95, 0.40, 0.05 }, { 1.0, 1.00, 0.75, 0.15 }, { 1.0 + 1e-3, 0.86, 0.92, 0.96 },
  { 2.0, 0.72, 0.83, 0.91 } };

// The settings of one array, by the names of ParaView's proxy PVLookupTable.
void Write(const ColorMap& map, std::ostream& json)
{
  json << '"' << map.Array << R"(":{"Title":")" << map.Title << R"(","PVLookupTable":{)"
       << R"("AutomaticRescaleRangeMode":-1,"ScalarRangeInitialized":1,"ColorSpace":0,)"
       << R"("NanColor":[0.6,0.6,0.6],"RGBPoints":[)";
  const char* comma = "";
  for (const Color& c : Colors)
  {
    const double value = c.Place <= 1.0 ? c.Place * map.Bad
                                        : map.Bad + (c.Place - 1.0) * (map.Most - map.Bad);
    json << comma << value << ',' << c.Red << ',' << c.Green << ',' << c.Blue;
    comma = ",";
  }
  json << "]}}";
}

} // namespace

//------------------------------------------------------------------------------
void MeshOptimizeAddColorMaps()
{
  std::ostringstream json;
  json.imbue(std::locale::classic()); // no decimal commas
  json << R"({"array_lookup_tables":{)";
  const char* comma = "";
  for (const ColorMap& map : ColorMaps)
  {
    json << comma;
    Write(map, json);
    comma = ",";
  }
  json << "}}";
  vtkSMSettings::GetInstance()->AddCollectionFromString(json.str(), 0.0); // the least priority
}
