// SPDX-License-Identifier: BSD-3-Clause
// PrintSelf names every property and its value: all settings of the register show in it, and there
// is no property that the register has not. What the values are by default, python.TestDefaults
// compares with the XML.
#include "KindTest.h"

#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

namespace
{

using Lines = std::map<std::string, std::string>;

// The properties of a filter with their values; of what VTK itself prints, nothing.
Lines printed(vtkAlgorithm* filter)
{
  std::ostringstream os;
  filter->Print(os);
  std::istringstream all(os.str());
  Lines lines;
  bool isOwn = false;
  for (std::string line; std::getline(all, line);)
  {
    const std::size_t colon = line.find(": ");
    if (isOwn && colon != std::string::npos && line.compare(0, 2, "  ") == 0)
    {
      lines[line.substr(2, colon - 2)] = line.substr(colon + 2);
    }
    isOwn = isOwn || line.compare(0, 16, "  Progress Text:") == 0;
  }
  return lines;
}

// The numbers of a text; none if there is anything else in it.
std::vector<double> parseNumbers(const std::string& text)
{
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;)
  {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0')
    {
      return {};
    }
  }
  return numbers;
}

// Whether two texts are as many numbers and, but for rounding, the same; or not numbers both.
bool agree(const std::string& one, const std::string& other)
{
  const std::vector<double> a = parseNumbers(one);
  const std::vector<double> b = parseNumbers(other);
  bool same = true;
  for (std::size_t i = 0; a.size() == b.size() && i < a.size(); ++i)
  {
    const double tolerance = 1e-5 * std::abs(a[i]) + 1e-6;
    same = same &&
      (a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])) || std::abs(a[i] - b[i]) < tolerance);
  }
  return same;
}

// What is printed, but is no property that is set.
const std::set<std::string> readOnly{ "DensityPort", "NumberOfSolutions", "TableBuildTime" };

void checkKind(Checks& checks, const Campaign::FilterKind& kind)
{
  const std::string name = kind.Name;
  const Lines usual = printed(kind.New());
  checks.That(!usual.empty(), "is printed", __LINE__, name);
  std::set<std::string> drawn;              // all that the register sets
  std::set<std::string> changed;            // those whose line is then another one
  std::map<std::string, Lines> textOfValue; // of each property, by the value's text in the register
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
  {
    Campaign::RandomSource random(seed);
    Campaign::Settings settings(random);
    kind.DrawSettings(settings);
    kind.DrawInputs(random, settings);
    const auto filter = kind.New();
    settings.Apply(filter);
    const Lines now = printed(filter);
    checks.That(now.size() == usual.size(), "as many lines", __LINE__, name);
    std::map<std::string, std::string> last;
    for (const Campaign::Setting& setting : settings.GetAll())
    {
      last[setting.Name] = setting.Text;
    }
    for (const auto& [property, text] : last)
    {
      if (property == "Array" || property == "Time")
      {
        continue; // of vtkAlgorithm and of the request
      }
      drawn.insert(property);
      const auto line = now.find(property);
      if (line == now.end())
      {
        checks.That(false, "is printed", __LINE__, name + ": " + property);
        return;
      }
      if (line->second != usual.at(property))
      {
        changed.insert(property);
      }
      textOfValue[property][text] = line->second;
      checks.That(agree(line->second, text), "the value is printed", __LINE__,
        name + ": " + property + ": " + line->second + " of " + text);
    }
  }
  for (const std::string& property : drawn)
  {
    checks.That(
      changed.count(property) == 1, "shows in what is printed", __LINE__, name + ": " + property);
  }
  for (const auto& [property, text] : usual)
  {
    checks.That(drawn.count(property) + readOnly.count(property) == 1, "is in the register",
      __LINE__, name + ": " + property);
  }
  // Of choices, each value has a text of its own; those that are none have "Unknown".
  for (const auto& [property, texts] : textOfValue)
  {
    std::set<std::string> different;
    std::size_t known = 0;
    bool areChoices = true;
    for (const auto& [value, text] : texts)
    {
      areChoices = areChoices && text.find_first_of("0123456789") == std::string::npos;
      known += text == "Unknown" ? 0 : 1;
      different.insert(text);
    }
    different.erase("Unknown");
    checks.That(!areChoices || different.size() == known, "different texts", __LINE__,
      name + ": " + property);
  }
}

void checkKinds(Checks& checks)
{
  CHECK(checks, Campaign::filterKinds().size() >= 13);
  for (const Campaign::FilterKind& kind : Campaign::filterKinds())
  {
    checkKind(checks, kind);
  }
}

} // namespace

int TestPrintSelf(int, char*[])
{
  vtkObject::GlobalWarningDisplayOff(); // of setters that refuse a value
  return runChecks({ checkKinds });
}
