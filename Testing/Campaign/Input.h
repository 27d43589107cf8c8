// SPDX-License-Identifier: BSD-3-Clause
// Inputs that a case gives to a filter, with what is known of them.
#ifndef Campaign_Input_h
#define Campaign_Input_h

#include "RandomSource.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <string>
#include <vector>

namespace Campaign
{

// What a filter has to make of an input.
enum class State
{
  Sound,  // a valid output
  Empty,  // an empty output without an error
  Odd,    // a valid output, or an error
  Faulty, // an error
  Open,   // whatever an input may make of it, even nothing
};

// Of two that meet in one run.
inline State worse(State a, State b)
{
  if (a == b || a == State::Sound || b == State::Sound)
  {
    return a == State::Sound ? b : a;
  }
  // What is empty need not be looked at for faults.
  const bool anyOpen =
    a == State::Empty || b == State::Empty || a == State::Open || b == State::Open;
  return anyOpen ? State::Open : State::Faulty;
}

struct Input
{
  vtkSmartPointer<vtkDataObject> Data; // nullptr where nothing is connected
  State Condition = State::Sound;      // its values aside
  std::string Text;
  // The array that the filter is to read and how it is chosen; nullptr for the default.
  vtkSmartPointer<vtkDataArray> Values;
  vtkSmartPointer<vtkStringArray> Texts; // if the data have text, which holds Values
  bool OnPoints = true;
  bool IsPlain = true; // one data set of the right type
  // Of a series all of its steps, of which the first has the data above, and the source of them.
  std::vector<Input> Steps;
  std::vector<double> Times; // of the steps, as announced: in any order, at times repeated or NaN
  vtkSmartPointer<vtkAlgorithm> Series;

  void Worsen(State state) { this->Condition = worse(this->Condition, state); }
  void Describe(const std::string& text) { this->Text += (this->Text.empty() ? "" : ", ") + text; }
};

struct ImageRules
{
  int Dimension = 0;          // 0: any
  bool OrientedLikes = false; // no direction matrix
  int LargestAxis = 40;       // in 2D; more in 1D, less in 3D
};

// An image with an array of some type and some values, on its points or its cells.
Input drawImage(RandomSource& random, const ImageRules& rules = {});

// Points in and about the box of an image, which may be nullptr.
Input drawPoints(RandomSource& random, vtkImageData* about, vtkIdType most);

// Closed surfaces and others.
Input drawSurface(RandomSource& random);

// Regions with masses: polygons or closed lines, at times in blocks, with the cell arrays "Mass"
// and "Land".
Input drawMap(RandomSource& random);

// Disks and others. `boundary` gets the points around it, of a disk.
Input drawDisk(RandomSource& random, std::vector<vtkIdType>& boundary);

// An array of `tuples` tuples of any type, which may hold what no density may.
vtkSmartPointer<vtkDataArray> drawArray(
  RandomSource& random, vtkIdType tuples, int components, std::string& text);

// Marks some of the points or cells; at times by an array of the wrong length, where that is
// allowed.
void drawGhosts(RandomSource& random, vtkDataSetAttributes* attributes, vtkIdType tuples,
  bool anyLength, Input& input);

// In place of a plain input at times nothing, another type, or a composite data set.
void drawUnusual(RandomSource& random, Input& input);

// Writes over some values or points of an input, in place; of a series, of one of its steps.
void changeInPlace(RandomSource& random, Input& input);

// A number that may be none.
double drawExceptional(RandomSource& random);

std::string textOf(double value);

} // namespace Campaign

#endif
