// SPDX-License-Identifier: BSD-3-Clause
// Arrays of text that hold numbers alone, as densities and as masses, give what these numbers give.
#include "BlocksTest.h"
#include "TestData.h"

#include "vtkAppendFilter.h"
#include "vtkCartogram.h"
#include "vtkCellArray.h"
#include "vtkMassSplatter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlaneSource.h"
#include "vtkStringArray.h"
#include "vtkSurfaceSampler.h"
#include "vtkTable.h"
#include "vtkTransportQuality.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariantArray.h"

#include <clocale>
#include <cstdio>
#include <string>

namespace
{

using TextOf = std::function<std::string(double)>;

std::string digits(double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

vtkSmartPointer<vtkStringArray> textsOf(vtkDataArray* numbers, const TextOf& text = digits)
{
  const auto texts = vtkSmartPointer<vtkStringArray>::New();
  texts->SetName(numbers->GetName());
  texts->SetNumberOfComponents(numbers->GetNumberOfComponents());
  texts->SetNumberOfTuples(numbers->GetNumberOfTuples());
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    const int components = numbers->GetNumberOfComponents();
    texts->SetValue(
      i, text(numbers->GetComponent(i / components, static_cast<int>(i % components))));
  }
  return texts;
}

vtkSmartPointer<vtkDataSet> copyOf(vtkDataSet* data)
{
  const auto copy = vtkSmartPointer<vtkDataSet>::Take(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

// The same with text for the array, which is then no attribute.
vtkSmartPointer<vtkDataSet> withTexts(
  vtkDataSet* data, bool cells, const char* name, const TextOf& text = digits)
{
  const auto copy = copyOf(data);
  vtkDataSetAttributes* attributes =
    copy->GetAttributes(cells ? vtkDataObject::CELL : vtkDataObject::POINT);
  const vtkSmartPointer<vtkDataArray> numbers = attributes->GetArray(name);
  attributes->RemoveArray(name);
  attributes->AddArray(textsOf(numbers, text));
  return copy;
}

struct Read
{
  Values Places;
  double Mass;
  std::vector<std::string> Errors;
};

Read sampleOf(
  vtkDataObject* data, bool cells, const char* name = "Density", bool nanIsEmpty = false)
{
  vtkNew<vtkTransportSampler> sampler;
  Messages messages(sampler);
  sampler->SetInputDataObject(data);
  sampler->SetNumberOfParticles(200);
  sampler->SetNaNValues(nanIsEmpty);
  sampler->SetInputArrayToProcess(0, 0, 0, cells ? 1 : 0, name);
  sampler->Update();
  return { coordinates(sampler->GetOutput()), fieldValue(sampler->GetOutput(), "TotalMass"),
    messages.Errors };
}

void checkImages(Checks& checks)
{
  for (const bool cells : { false, true })
  {
    for (const int components : { 1, 3 })
    {
      auto image = makeImage(19, 11, 1, cells, bumpy, components);
      const Read numbers = sampleOf(image, cells);
      const auto texts = withTexts(image, cells, "Density");
      const Read read = sampleOf(texts, cells);
      CHECK(checks, numbers.Places.size() == 600 && read.Errors.empty());
      CHECK(checks, read.Places == numbers.Places && read.Mass == numbers.Mass);
      // Both are of the same input: nothing of it changes.
      CHECK(checks, !vtkDataArray::SafeDownCast(texts->GetAttributes(cells)->GetAbstractArray(0)));
      // By default no text is a density.
      vtkNew<vtkTransportSampler> sampler;
      Messages messages(sampler);
      sampler->SetInputData(texts);
      sampler->Update();
      CHECK(checks, messages.IsOneError("no active scalars"));
    }
  }
}

// Changed texts are another density.
void checkChanges(Checks& checks)
{
  const auto texts = withTexts(makeImage(19, 11, 1, true, bumpy), true, "Density");
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(texts);
  sampler->SetNumberOfParticles(20);
  sampler->SetInputArrayToProcess(0, 0, 0, 1, "Density");
  sampler->Update();
  const double mass = fieldValue(sampler->GetOutput(), "TotalMass");
  auto* array = vtkStringArray::SafeDownCast(texts->GetCellData()->GetAbstractArray(0));
  array->SetValue(0, std::to_string(bumpy(0) + 50));
  array->Modified();
  texts->Modified();
  sampler->Update();
  CHECK(checks, fieldValue(sampler->GetOutput(), "TotalMass") == mass + 50);
}

void checkMeshes(Checks& checks)
{
  for (const bool cells : { false, true })
  {
    auto image = makeImage(9, 7, 5, cells, bumpy);
    vtkNew<vtkAppendFilter> append;
    append->AddInputData(image);
    append->Update();
    vtkUnstructuredGrid* mesh = append->GetOutput();
    const Read numbers = sampleOf(mesh, cells);
    const Read read = sampleOf(withTexts(mesh, cells, "Density"), cells);
    CHECK(checks, read.Errors.empty() && numbers.Places.size() == 600);
    CHECK(checks, read.Places == numbers.Places && read.Mass == numbers.Mass);
    // Blocks, one or all of them with text, which tile the image.
    for (const bool isFirst : { true, false })
    {
      auto blocks = makeTiles(image, 3);
      const Read ofBlocks = sampleOf(blocks, cells);
      for (unsigned int b = isFirst ? 0 : 1; b < 2; ++b)
      {
        blocks->SetBlock(
          b, withTexts(vtkDataSet::SafeDownCast(blocks->GetBlock(b)), cells, "Density"));
      }
      const Read mixed = sampleOf(blocks, cells);
      CHECK(checks, mixed.Errors.empty() && mixed.Places == ofBlocks.Places);
    }
  }
}

// The texts that are numbers, and their values.
void checkNumbers(Checks& checks)
{
  const std::pair<const char*, double> read[] = { { "42", 42 }, { "  42", 42 }, { "42 \t\r\n", 42 },
    { "+42", 42 }, { "4.2e1", 42 }, { "4.2E+01", 42 }, { "420e-1", 42 }, { "042", 42 },
    { "42.", 42 }, { ".5", 0.5 }, { "18446744073709551615", 18446744073709551615.0 },
    { "12345678901234567890", 12345678901234567890.0 }, { "0", 0 }, { "1e-320", 1e-320 },
    { "1e-400", 0 }, { "2.2250738585072014e-308", 2.2250738585072014e-308 } };
  for (const auto& [text, value] : read)
  {
    auto image = makeImage(5, 4, 1, true, bumpy);
    const double others = sampleOf(image, true).Mass - bumpy(3);
    const std::string own = text;
    const Read found =
      sampleOf(withTexts(image, true, "Density",
                 [&own](double number) { return number == bumpy(3) ? own : digits(number); }),
        true);
    auto like = makeImage(5, 4, 1, true,
      [value = value](vtkIdType i) { return bumpy(i) == bumpy(3) ? value : bumpy(i); });
    checks.That(
      found.Mass == sampleOf(like, true).Mass && others > 0, "is that number", __LINE__, text);
  }
  for (const char* text : { "n/a", "", " ", "4 2", "4,2", "1_000", "0x10", "42m", "--4", "+-4",
         "++4", "e5", "1e", ".", "+", "-", "\xc2\xbd" })
  {
    vtkIdType place = 0;
    const std::string own = text;
    const auto data = withTexts(makeImage(5, 4, 1, true, bumpy), true, "Density",
      [&](double number) { return place++ >= 7 && place <= 9 ? own : digits(number); });
    const Read found = sampleOf(data, true);
    checks.That(found.Errors.size() == 1 && found.Places.empty() &&
        contains(found.Errors[0], "'Density' is not numeric") &&
        contains(
          found.Errors[0], "2 of 12 texts are no numbers, the first '" + own + "' at index 7"),
      "is no number", __LINE__, text + (found.Errors.empty() ? "" : ": " + found.Errors[0]));
  }
}

// Decimal points are dots wherever the program runs.
void checkLocale(Checks& checks)
{
  auto image = makeImage(19, 11, 1, true, [](vtkIdType i) { return 0.25 + bumpy(i); });
  const auto texts = withTexts(image, true, "Density");
  const double mass = sampleOf(image, true).Mass;
  for (const char* name : { "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE" })
  {
    if (std::setlocale(LC_NUMERIC, name))
    {
      CHECK(checks, sampleOf(texts, true).Mass == mass);
    }
  }
  std::setlocale(LC_NUMERIC, "C");
}

// Texts without letters mark missing data where NaN does; "nan" is a number, which may do so.
void checkMissing(Checks& checks)
{
  auto image = makeImage(19, 11, 1, true, bumpy);
  const double mass = sampleOf(image, true).Mass;
  for (const char* text : { "", "  ", "nan", "NaN" })
  {
    vtkIdType place = 0;
    const std::string own = text;
    const auto data = withTexts(
      image, true, "Density", [&](double number) { return place++ == 5 ? own : digits(number); });
    const Read empty = sampleOf(data, true, "Density", true);
    CHECK(checks, empty.Errors.empty());
    CHECK_NEAR(checks, empty.Mass, mass - bumpy(5), 1e-9);
    const Read found = sampleOf(data, true);
    CHECK(checks, found.Errors.size() == 1 && contains(found.Errors[0], "index 5"));
  }
}

// Variants hold numbers, or text, or both.
void checkVariants(Checks& checks)
{
  auto image = makeImage(19, 11, 1, true, [](vtkIdType i) { return 1e6 + 1.0 / bumpy(i); });
  const Read numbers = sampleOf(image, true);
  vtkNew<vtkVariantArray> variants;
  variants->SetName("Density");
  vtkDataArray* values = image->GetCellData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    const double value = values->GetComponent(i, 0);
    variants->InsertNextValue(i % 2 == 0 ? vtkVariant(value) : vtkVariant(digits(value)));
  }
  image->GetCellData()->RemoveArray("Density");
  image->GetCellData()->AddArray(variants);
  const Read read = sampleOf(image, true);
  CHECK(checks, read.Errors.empty() && read.Mass == numbers.Mass && read.Places == numbers.Places);
  variants->SetValue(4, vtkVariant());
  CHECK(checks, sampleOf(image, true).Errors.size() == 1);
}

void checkPointMasses(Checks& checks)
{
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(makeImage(19, 11, 1, false, bumpy));
  sampler->SetNumberOfParticles(100);
  sampler->Update();
  vtkPolyData* particles = sampler->GetOutput();
  vtkDataArray* mass = pointArray(particles, "Mass");
  for (vtkIdType i = 0; i < 100; ++i)
  {
    mass->SetComponent(i, 0, bumpy(i) / 7);
  }
  const auto texts = withTexts(particles, false, "Mass");
  std::array<Values, 2> splats;
  std::array<double, 2> qualities{};
  for (std::size_t k = 0; k < 2; ++k)
  {
    vtkDataSet* input = k == 0 ? static_cast<vtkDataSet*>(particles) : texts.Get();
    vtkNew<vtkMassSplatter> splatter;
    splatter->SetInputData(input);
    splatter->SetInputArrayToProcess(0, 0, 0, 0, "Mass");
    splatter->Update();
    splats[k] = imageValues(splatter->GetOutput(), "Density");
    vtkNew<vtkTransportQuality> quality;
    quality->SetInputData(0, input);
    quality->SetInputData(1, makeImage(19, 11, 1, false, bumpy));
    quality->Update();
    qualities[k] = quality->GetOutput()->GetValueByName(0, "DensityError").ToDouble();
  }
  CHECK(checks, !splats[0].empty() && splats[0] == splats[1]);
  CHECK(checks, qualities[0] == qualities[1]);

  vtkStringArray::SafeDownCast(texts->GetPointData()->GetAbstractArray("Mass"))
    ->SetValue(3, "many");
  vtkNew<vtkMassSplatter> splatter;
  Messages messages(splatter);
  splatter->SetInputData(texts);
  splatter->SetInputArrayToProcess(0, 0, 0, 0, "Mass");
  splatter->Update();
  CHECK(checks, messages.IsOneError("1 of 100 texts is no number: 'many' at index 3"));
}

void checkSurfaces(Checks& checks)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(6, 4);
  plane->Update();
  for (const bool cells : { false, true })
  {
    const auto surface = copyOf(plane->GetOutput());
    vtkNew<vtkDoubleArray> density;
    density->SetName("D");
    for (vtkIdType i = 0; i < surface->GetNumberOfElements(cells); ++i)
    {
      density->InsertNextValue(bumpy(i));
    }
    surface->GetAttributes(cells)->AddArray(density);
    std::array<Values, 2> places;
    for (std::size_t k = 0; k < 2; ++k)
    {
      const auto texts = withTexts(surface, cells, "D");
      vtkNew<vtkSurfaceSampler> sampler;
      sampler->SetInputData(k == 0 ? surface : texts);
      sampler->SetNumberOfParticles(50);
      sampler->SetInputArrayToProcess(0, 0, 0, cells ? 1 : 0, "D");
      sampler->Update();
      places[k] = coordinates(sampler->GetOutput());
    }
    CHECK(checks, places[0].size() == 150 && places[0] == places[1]);
  }
}

// Two squares of masses 1 and 3 become areas of 1 : 3.
void checkRegions(Checks& checks)
{
  vtkNew<vtkPolyData> map;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  for (int x = 0; x < 3; ++x)
  {
    points->InsertNextPoint(x, 0, 0);
    points->InsertNextPoint(x, 1, 0);
  }
  for (const vtkIdType first : { 0, 2 })
  {
    const vtkIdType corners[] = { first, first + 2, first + 3, first + 1 };
    polygons->InsertNextCell(4, corners);
  }
  map->SetPoints(points);
  map->SetPolys(polygons);
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  vtkNew<vtkStringArray> people;
  people->SetName("People");
  for (const char* name : { "Hither", "Thither" })
  {
    names->InsertNextValue(name);
  }
  people->InsertNextValue("1000000000000");
  people->InsertNextValue(" 3e12");
  map->GetCellData()->AddArray(names);
  map->GetCellData()->AddArray(people);
  vtkNew<vtkCartogram> cartogram;
  Messages messages(cartogram);
  cartogram->SetInputData(map);
  cartogram->SetInputArrayToProcess(0, 0, 0, 1, "People");
  cartogram->SetResolution(128);
  cartogram->Update();
  CHECK(checks, messages.Errors.empty());
  vtkDataArray* errors = vtkDataSet::SafeDownCast(cartogram->GetOutputDataObject(0))
                           ->GetCellData()
                           ->GetArray("AreaError");
  for (vtkIdType i = 0; i < 2; ++i)
  {
    CHECK(checks, errors && std::abs(errors->GetComponent(i, 0)) <= 0.011);
  }
  people->SetValue(1, "unknown");
  people->Modified();
  map->Modified();
  cartogram->Update();
  CHECK(checks,
    messages.Errors.size() == 1 &&
      contains(messages.Errors[0], "'unknown' of the region 'Thither'"));
  // Text is never the mass that is not chosen.
  messages.Errors.clear();
  people->SetValue(1, "3");
  cartogram->SetInputArrayToProcess(0, 0, 0, 1, "");
  cartogram->Update();
  CHECK(
    checks, messages.Errors.size() == 1 && contains(messages.Errors[0], "MassArray is not set"));
}

} // namespace

int TestTextArrays(int, char*[])
{
  return runChecks({ checkImages, checkChanges, checkMeshes, checkNumbers, checkLocale,
    checkMissing, checkVariants, checkPointMasses, checkSurfaces, checkRegions });
}
