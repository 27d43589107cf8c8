// SPDX-License-Identifier: BSD-3-Clause
// The properties of a filter as a case draws them: most as they are by default, some from inside
// of their range, its ends among it, few from outside.
#ifndef Campaign_Settings_h
#define Campaign_Settings_h

#include "Input.h"
#include "RandomSource.h"

#include "vtkAlgorithm.h"

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace Campaign
{

struct Setting
{
  std::string Name;
  std::string Text; // of the value
  std::function<void(vtkAlgorithm*)> Apply;
  bool InRange = true;
  bool IsTooLarge = false; // for the memory: an error only where there is something to do
};

class Settings
{
public:
  explicit Settings(RandomSource& random)
    : Random(random)
    , Large(random.Chance(0.04))
  {
  }

  bool IsLarge() const { return this->Large; }

  RandomSource& GetRandom() { return this->Random; }

  // `used` of the properties are set, one in 70 of them to what is not allowed.
  template <class T, class Value>
  void Draw(const char* name, void (T::*set)(Value), std::initializer_list<Value> inside,
    std::initializer_list<Value> outside, double used = 0.5,
    std::initializer_list<Value> tooLarge = {})
  {
    if (!this->Random.Chance(used))
    {
      return;
    }
    const bool inRange = outside.size() == 0 || !this->Random.Chance(0.015);
    const bool isTooLarge = !inRange && tooLarge.size() > 0 && this->Random.Chance(0.5);
    const Value value = this->Random.Of(isTooLarge ? tooLarge : inRange ? inside : outside);
    this->Add(
      name, std::to_string(value),
      [set, value](vtkAlgorithm* filter) { (static_cast<T*>(filter)->*set)(value); }, inRange,
      isTooLarge);
  }

  void Add(const std::string& name, const std::string& text,
    std::function<void(vtkAlgorithm*)> apply, bool inRange = true, bool isTooLarge = false)
  {
    this->All.push_back({ name, text, std::move(apply), inRange, isTooLarge });
  }

  void Apply(vtkAlgorithm* filter) const
  {
    for (const Setting& setting : this->All)
    {
      setting.Apply(filter);
    }
  }

  // Whether a property has a value in range that others may not go with.
  bool IsOdd() const
  {
    bool odd = false;
    for (const Setting& setting : this->All)
    {
      odd = setting.Name == "Tables" ? setting.Text == "2" : odd; // Tiled
    }
    return odd;
  }

  // The last values of properties where they are out of range.
  std::vector<Setting> OutOfRange() const
  {
    std::vector<Setting> found;
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      bool last = true;
      for (std::size_t j = i + 1; j < this->All.size(); ++j)
      {
        last = last && this->All[j].Name != this->All[i].Name;
      }
      if (last && !this->All[i].InRange)
      {
        found.push_back(this->All[i]);
      }
    }
    return found;
  }

  std::string Describe(std::size_t from = 0) const
  {
    std::string text;
    for (std::size_t i = from; i < this->All.size(); ++i)
    {
      text += " " + this->All[i].Name + "=" + this->All[i].Text;
    }
    return text;
  }

  const std::vector<Setting>& GetAll() const { return this->All; }

  std::size_t Count() const { return this->All.size(); }

private:
  RandomSource& Random;
  bool Large;
  std::vector<Setting> All;
};

} // namespace Campaign

#endif
