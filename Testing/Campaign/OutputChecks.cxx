// SPDX-License-Identifier: BSD-3-Clause
#include "OutputChecks.h"

#include "vtkDataSetAttributes.h"
#include "vtkDensityAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkTransportAlgorithm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Campaign
{

void Findings::Near(double a, double b, double tolerance, const std::string& what)
{
  std::ostringstream text;
  text.precision(17);
  text << what << ": " << a << " and " << b;
  // Numbers below the least normal one have fewer digits.
  const double size = std::max({ std::abs(a), std::abs(b), std::numeric_limits<double>::min() });
  this->That(a == b || std::abs(a - b) <= tolerance * size, text.str());
}

namespace
{

constexpr int automatic = -1;
constexpr int luminance = -2;
constexpr int magnitude = -3;

// Whether there is such a component, or another value of all of them.
bool hasComponent(int component, vtkDataArray* array)
{
  const int count = array->GetNumberOfComponents();
  const bool isByte =
    array->GetDataType() == VTK_UNSIGNED_CHAR || array->GetDataType() == VTK_UNSIGNED_SHORT;
  return component == magnitude || (component >= 0 && component < count) ||
    (component == luminance && count <= 4) || (component == automatic && (count <= 4 || !isByte));
}

// Of a magnitude each component counts.
bool isAnyOutside(vtkDataArray* array, vtkIdType i, const double* range)
{
  bool is = false;
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    const double value = array->GetComponent(i, c);
    is = is || value < range[0] || value > range[1];
  }
  return is;
}

// Whether the value is the luminance of several components, whose colours only the filter knows.
bool isColour(int component, vtkDataArray* array)
{
  const bool isByte =
    array->GetDataType() == VTK_UNSIGNED_CHAR || array->GetDataType() == VTK_UNSIGNED_SHORT;
  return array->GetNumberOfComponents() > 1 &&
    (component == luminance || (component == automatic && isByte));
}

} // namespace

double valueAt(vtkAlgorithm* filter, const Input& input, vtkIdType i)
{
  const int component = vtkDensityAlgorithm::SafeDownCast(filter)->GetComponent();
  vtkDataArray* array = input.Values;
  const int count = array->GetNumberOfComponents();
  if (component >= 0 || (count == 1 && component != magnitude))
  {
    return array->GetComponent(i, std::max(component, 0));
  }
  double squares = 0.0;
  double norm = 0.0; // whose squares may overflow
  for (int c = 0; c < count; ++c)
  {
    const double value = array->GetComponent(i, c);
    squares += value * value;
    norm = std::hypot(norm, value);
  }
  return squares > 1e-280 && std::isfinite(squares) ? std::sqrt(squares) : norm;
}

State densityState(vtkAlgorithm* filter, const Input& input)
{
  auto* reader = vtkDensityAlgorithm::SafeDownCast(filter);
  vtkDataArray* array = input.Values;
  if (input.Condition != State::Sound || !array || reader->GetInvertDensity())
  {
    return worse(input.Condition, reader->GetInvertDensity() ? State::Odd : State::Sound);
  }
  if (!hasComponent(reader->GetComponent(), array))
  {
    return State::Faulty;
  }
  if (isColour(reader->GetComponent(), array))
  {
    return State::Odd;
  }
  double sum = 0.0;
  double largest = 0.0;
  const double* valid = reader->GetValidRange();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = valueAt(filter, input, i);
    if ((std::isnan(value) && reader->GetNaNValues() != vtkDensityAlgorithm::NAN_VALUES_ERROR) ||
      isAnyOutside(array, i, valid))
    {
      return State::Odd; // nothing may be left
    }
    if (!std::isfinite(value) ||
      (value < 0.0 && reader->GetNegativeValues() == vtkDensityAlgorithm::NEGATIVE_VALUES_ERROR))
    {
      return State::Faulty;
    }
    sum += std::max(value, 0.0);
    largest = std::max(largest, value);
  }
  if (sum == 0.0)
  {
    return State::Faulty;
  }
  const bool usual = sum < 1e290 && largest > 1e-280;
  return usual ? State::Sound : State::Odd;
}

double massOf(vtkAlgorithm* filter, const Input& input)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < input.Values->GetNumberOfTuples(); ++i)
  {
    sum += std::max(valueAt(filter, input, i), 0.0);
  }
  return sum * cellMeasure(vtkImageData::SafeDownCast(input.Data));
}

double cellMeasure(vtkImageData* image)
{
  double measure = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    measure *= image->GetDimensions()[a] > 1 ? std::abs(image->GetSpacing()[a]) : 1.0;
  }
  return measure;
}

vtkDataArray* requireArray(
  vtkFieldData* data, const char* name, int components, vtkIdType tuples, Findings& findings)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array)
  {
    findings.That(false, std::string("no array ") + name);
    return nullptr;
  }
  const bool shape =
    array->GetNumberOfComponents() == components && array->GetNumberOfTuples() == tuples;
  findings.That(shape, std::string("shape of ") + name);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      if (!std::isfinite(array->GetComponent(i, c)))
      {
        findings.That(false,
          std::string(name) + " of " + std::to_string(i) + " is " +
            textOf(array->GetComponent(i, c)));
        return nullptr;
      }
    }
  }
  return shape ? array : nullptr;
}

vtkDataArray* requireDensity(vtkImageData* image, bool onPoints, Findings& findings)
{
  const int kind = onPoints ? vtkDataObject::POINT : vtkDataObject::CELL;
  return requireArray(
    image->GetAttributes(kind), "Density", 1, image->GetNumberOfElements(kind), findings);
}

double requireField(vtkDataObject* data, const char* name, Findings& findings)
{
  vtkDataArray* array = requireArray(data->GetFieldData(), name, 1, 1, findings);
  return array ? array->GetComponent(0, 0) : 0.0;
}

void checkBound(vtkTransportAlgorithm* filter, vtkDataObject* output, bool isWhole, double cost,
  Findings& findings)
{
  const bool isOptimal = filter->GetMethod() == vtkTransportAlgorithm::OPTIMAL;
  vtkFieldData* fields = output->GetFieldData();
  vtkDataArray* gaps = fields->GetArray("OptimalityGap");
  if (!isWhole || (!isOptimal && !filter->GetCertify()))
  {
    findings.That(!gaps && !fields->GetArray("TransportCostLowerBound"), "no bound");
    return;
  }
  const double bound = requireField(output, "TransportCostLowerBound", findings);
  findings.That(bound >= 0.0, "TransportCostLowerBound is " + textOf(bound));
  findings.That(gaps && gaps->GetNumberOfTuples() == 1, "a gap");
  const double gap = gaps ? gaps->GetComponent(0, 0) : 0.0;
  findings.That(gap >= 0.0, "OptimalityGap is " + textOf(gap));
  // Without a bound above rounding it is 0 or infinite.
  if (gap > 0.0 && std::isfinite(gap))
  {
    findings.Near(1.0 + gap, std::max(1.0, cost / bound), 1e-9, "OptimalityGap");
  }
}

void requireFinitePoints(vtkPointSet* set, Findings& findings)
{
  double x[3];
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    set->GetPoint(i, x);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
    {
      findings.That(false, "point " + std::to_string(i) + " is not finite");
      return;
    }
  }
  findings.That(set->GetPoints()->GetDataType() == VTK_DOUBLE, "points are double");
}

void requireVertices(vtkPolyData* particles, Findings& findings)
{
  findings.That(particles->GetNumberOfVerts() == particles->GetNumberOfPoints() &&
      particles->GetNumberOfCells() == particles->GetNumberOfPoints(),
    "one vertex a particle");
}

double sumOf(vtkDataArray* array, int component)
{
  double sum = 0.0;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    sum += array->GetComponent(i, component);
  }
  return sum;
}

void requireInside(vtkPointSet* set, const Input& density, Findings& findings)
{
  auto* image = vtkImageData::SafeDownCast(density.Data);
  const int* extent = image->GetExtent();
  const double margin = (density.OnPoints ? 0.5 : 0.0) + 1e-6;
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i)
  {
    double x[3];
    double index[3];
    set->GetPoint(i, x);
    image->TransformPhysicalPointToContinuousIndex(x, index);
    for (int a = 0; a < 3; ++a)
    {
      const double grown = extent[2 * a] < extent[2 * a + 1] ? margin : 1e-6;
      if (!(index[a] >= extent[2 * a] - grown && index[a] <= extent[2 * a + 1] + grown))
      {
        findings.That(false,
          "particle " + std::to_string(i) + " is at " + textOf(index[a]) + " of axis " +
            std::to_string(a));
        return;
      }
    }
  }
}

void requirePassed(
  vtkFieldData* from, vtkFieldData* to, std::initializer_list<const char*> own, Findings& findings)
{
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    const char* name = from->GetAbstractArray(i)->GetName();
    const bool isOwn = name && std::any_of(own.begin(), own.end(), [name](const char* other) {
      return std::string(name) == other;
    });
    if (name && !isOwn)
    {
      findings.That(to->GetAbstractArray(name) == from->GetAbstractArray(i),
        std::string("array ") + name + " is passed on");
    }
  }
}

} // namespace Campaign
