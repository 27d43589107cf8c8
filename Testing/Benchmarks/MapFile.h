// SPDX-License-Identifier: BSD-3-Clause
// Maps of GeoJSON files: features with a `mass` and polygons.
#ifndef RectifiedTransport_MapFile_h
#define RectifiedTransport_MapFile_h

#include "Core/Cartogram/RegionMap.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace RectifiedTransport
{

struct MapFile
{
  RegionMap Map;              // a region a feature
  std::vector<double> Masses; // none if the file has not one for each feature
  // What another program needed to make the map, where it says so.
  double Seconds = 0.0;
  double Megabytes = 0.0;
};

class MapFileReader
{
public:
  explicit MapFileReader(const std::string& path)
  {
    std::ifstream file(path);
    this->Text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }

  MapFile Read()
  {
    MapFile read;
    std::int32_t regions = 0;
    for (std::size_t at = 0; (at = this->Text.find("\"coordinates\"", at)) != std::string::npos;)
    {
      at = this->ReadRings(this->Text.find('[', at), regions, read.Map);
      ++regions;
    }
    read.Map.FindHoles();
    for (std::size_t at = 0; (at = this->Text.find("\"mass\"", at)) != std::string::npos; ++at)
    {
      read.Masses.push_back(this->NumberAfter(at));
    }
    if (read.Masses.size() != static_cast<std::size_t>(regions))
    {
      read.Masses.clear();
    }
    read.Seconds = this->NumberAfter(this->Text.find("\"seconds\""));
    read.Megabytes = this->NumberAfter(this->Text.find("\"megabytes\""));
    return read;
  }

private:
  double NumberAfter(std::size_t name) const
  {
    const std::size_t colon = name == std::string::npos ? name : this->Text.find(':', name);
    return colon == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                      : std::strtod(this->Text.c_str() + colon + 1, nullptr);
  }

  // Of a list of lists; its innermost ones are points, theirs are rings.
  std::size_t ReadRings(std::size_t at, std::int32_t region, RegionMap& map) const
  {
    std::vector<Point<2>> places;
    std::size_t lastEnd = std::string::npos; // of a list
    int depth = 0;
    do
    {
      const char next = this->Text[at];
      if (next == '[')
      {
        ++depth;
      }
      else if (next == ']')
      {
        --depth;
        if (!places.empty() && this->Text.find_last_not_of(" \n", at - 1) == lastEnd)
        {
          places.pop_back(); // where it begins
          std::vector<std::int64_t> ring;
          for (const Point<2>& place : places)
          {
            ring.push_back(map.AddPoint(place));
          }
          map.AddRing(region, ring);
          places.clear();
        }
        lastEnd = at;
      }
      else if (next == '-' || (next >= '0' && next <= '9'))
      {
        Point<2> place;
        char* end = nullptr;
        place[0] = std::strtod(this->Text.c_str() + at, &end);
        const std::size_t comma =
          this->Text.find(',', static_cast<std::size_t>(end - this->Text.c_str()));
        place[1] = std::strtod(this->Text.c_str() + comma + 1, &end);
        places.push_back(place);
        at = static_cast<std::size_t>(end - this->Text.c_str());
        continue;
      }
      ++at;
    } while (depth > 0);
    return at;
  }

  std::string Text;
};

} // namespace RectifiedTransport

#endif
