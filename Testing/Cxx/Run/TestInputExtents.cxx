// SPDX-License-Identifier: BSD-3-Clause
// Extents that end before they begin, or that are longer than an int, are one error in each filter.
#include "BlendTest.h"

#include "Bridge/VTKCompatibility.h"

#include "vtkEqualMassCells.h"
#include "vtkMassSplatter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkTransportMap.h"
#include "vtkTransportSampler.h"

#include <limits>

namespace
{

constexpr int least = std::numeric_limits<int>::min();
constexpr int most = std::numeric_limits<int>::max();

// The end of an extent, and what it becomes.
struct Wrong
{
  std::size_t End;
  int Value;
};

const std::vector<Wrong> wrongEnds{ { 0, 1000 }, { 1, -2 }, { 3, least }, { 4, 7 }, { 0, least },
  { 5, most } };

std::array<int, 6> extentWith(const Wrong& wrong)
{
  std::array<int, 6> extent{ 0, 5, 0, 4, 0, 0 };
  extent[wrong.End] = wrong.Value;
  return extent;
}

void expect(Checks& checks, vtkAlgorithm* filter, const char* name, int line)
{
  ErrorTest test(checks, filter);
  test.Expect({ name, " has the extent ", "each axis must end no earlier than it begins" }, line);
}

#ifdef RECTIFIEDTRANSPORT_VTK_HAS_IMAGES_OF_ANY_EXTENT
void checkImages(Checks& checks)
{
  for (const Wrong& wrong : wrongEnds)
  {
    auto image = makeImage(6, 5, 1, true, bumpy);
    image->SetExtent(extentWith(wrong).data());
    vtkNew<vtkTransportSampler> sampler;
    sampler->SetInputData(image);
    expect(checks, sampler, "Input port 0", __LINE__);
    vtkNew<vtkTransportMap> map;
    map->SetInputData(image);
    expect(checks, map, "Input port 0", __LINE__);
    vtkNew<vtkMassSplatter> splatter;
    splatter->SetInputData(makePoints({ 1, 1, 0, 2, 3, 0 }));
    splatter->SetInputData(1, image);
    expect(checks, splatter, "Input port 1", __LINE__);
    vtkNew<vtkEqualMassCells> cells;
    cells->SetInputData(makePoints({ 1, 1, 0, 2, 3, 0 }));
    cells->SetInputData(1, image);
    expect(checks, cells, "Input port 1", __LINE__);
    expect(checks, makeMorph(image, image), "Input port 0", __LINE__);
  }
}
#else
void checkImages(Checks&) {}
#endif

void checkGrids(Checks& checks)
{
  for (const Wrong& wrong : wrongEnds)
  {
    vtkNew<vtkTransportSampler> sampler;
    vtkNew<vtkRectilinearGrid> lattice;
    lattice->SetExtent(extentWith(wrong).data());
    sampler->SetInputData(lattice);
    expect(checks, sampler, "Input port 0", __LINE__);
    vtkNew<vtkStructuredGrid> grid;
    grid->SetExtent(extentWith(wrong).data());
    sampler->SetInputData(grid);
    expect(checks, sampler, "Input port 0", __LINE__);
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, makeImage(6, 5, 1, true, bumpy));
    blocks->SetBlock(1, lattice);
    sampler->SetInputDataObject(blocks);
    expect(checks, sampler, "Block 2 of input port 0", __LINE__);
  }
}

// The extent of nothing is none of these.
void checkEmpty(Checks& checks)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(0, -1, 0, -1, 0, -1);
  vtkNew<vtkTransportSampler> sampler;
  sampler->SetInputData(image);
  ErrorTest test(checks, sampler);
  test.ExpectNone(__LINE__);
}

} // namespace

int TestInputExtents(int, char*[])
{
  return runChecks({ checkImages, checkGrids, checkEmpty });
}
