// SPDX-License-Identifier: BSD-3-Clause
// The grid of what lies between densities of different sizes, spacings and boxes: the smallest box
// of all at the finest spacing, but with no more cells than the input that has most, published
// before the data, the same at every Parameter.
#include "BlendTest.h"
#include "InformationTest.h"

#include "vtkImageShrink3D.h"
#include "vtkPointDataToCellData.h"
#include "vtkRTAnalyticSource.h"

namespace
{

using Triple = std::array<double, 3>;

struct Box
{
  Counts Values;
  Triple Spacing;
  Triple Origin;
};

vtkSmartPointer<vtkImageData> makeBox(const Box& box, bool cells)
{
  auto image = makeDensity(box.Values, cells, bumpy);
  image->SetSpacing(box.Spacing.data());
  image->SetOrigin(box.Origin.data());
  return image;
}

void expectGrid(Checks& checks, vtkTransportBlend* blend, const Box& box, bool cells, int line)
{
  for (const double parameter : { 0.0, 0.3, 1.0 })
  {
    if (auto* morph = vtkTransportInterpolator::SafeDownCast(blend))
    {
      morph->SetParameter(parameter);
    }
    checkInformation(checks, blend, line);
    vtkImageData* image = blend->GetDensity();
    const int* extent = image->GetExtent();
    std::ostringstream found;
    for (int a = 0; a < 3; ++a)
    {
      found << extent[2 * a] << ".." << extent[2 * a + 1] << " " << image->GetSpacing()[a] << " "
            << image->GetOrigin()[a] << "; ";
    }
    for (std::size_t a = 0; a < 3; ++a)
    {
      const int most = box.Values[a] == 1 ? 0 : cells ? box.Values[a] : box.Values[a] - 1;
      checks.That(extent[2 * a] == 0 && extent[2 * a + 1] == most, "extent", line, found.str());
      checks.That(std::abs(image->GetSpacing()[a] - box.Spacing[a]) <= 1e-12 &&
          std::abs(image->GetOrigin()[a] - box.Origin[a]) <= 1e-12,
        "spacing and origin", line, found.str());
    }
    vtkDataSetAttributes* data = image->GetPointData();
    if (cells)
    {
      data = image->GetCellData();
    }
    checks.That(data->GetScalars() != nullptr, "association", line);
  }
}

void checkUnion(Checks& checks)
{
  const Box source = { { 8, 6, 1 }, { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 3.0 } };
  // To 9.75 along x and from -1 to 6 along y. With the finest spacings of 0.75 and 1 these are 13 x
  // 7 cells, more than the 48 of the source; 13/9 times as much is the least with which there are
  // no more: 9 x 5, rounded up along y, where the box grows at its upper end.
  const Box target = { { 5, 4, 1 }, { 0.75, 1.75, 9.0 }, { 6.0, -1.0, 3.0 } };
  auto morph = makeMorph(makeBox(source, true), makeBox(target, true));
  expectGrid(checks, morph, { { 9, 5, 1 }, { 9.75 / 9.0, 13.0 / 9.0, 1.0 }, { 0.0, -1.0, 3.0 } },
    true, __LINE__);

  // To 9.5, which is no multiple of 0.7.
  Box uneven = target;
  uneven.Spacing[0] = 0.7;
  morph->SetTargetData(makeBox(uneven, true));
  expectGrid(checks, morph, { { 9, 5, 1 }, { 9.5 / 9.0, 9.5 / 6.3, 1.0 }, { 0.0, -1.0, 3.0 } },
    true, __LINE__);

  // So many values are on the smallest box, which then is not grown.
  morph->SetDimensions(19, 0, 0);
  expectGrid(
    checks, morph, { { 19, 5, 1 }, { 0.5, 9.5 / 6.3, 1.0 }, { 0.0, -1.0, 3.0 } }, true, __LINE__);
  morph->SetDimensions(0, 28, 1);
  expectGrid(
    checks, morph, { { 9, 28, 1 }, { 9.5 / 9.0, 0.25, 1.0 }, { 0.0, -1.0, 3.0 } }, true, __LINE__);
  morph->SetDimensions(38, 2, 0);
  expectGrid(
    checks, morph, { { 38, 2, 1 }, { 0.25, 3.5, 1.0 }, { 0.0, -1.0, 3.0 } }, true, __LINE__);
}

// Points are the centres of dual cells, whose domain reaches half a spacing further.
void checkPoints(Checks& checks)
{
  const Box source = { { 8, 6, 3 }, { 1.0, 1.0, 2.0 }, { 0.5, 0.5, 1.0 } };
  const Box target = { { 5, 4, 3 }, { 0.75, 1.75, 2.0 }, { 6.0, -1.0, 2.0 } };
  auto points = makeBox(source, false);
  auto cells = makeBox(target, true);
  // z: [0, 6] and [2, 8]. Of 13 x 7 x 4 cells, 9 x 5 x 3 remain.
  const Triple spacing = { 9.75 / 9.0, 13.0 / 9.0, 26.0 / 9.0 };
  const Triple first = { 0.5 * spacing[0], 0.5 * spacing[1] - 1.0, 0.5 * spacing[2] };
  expectGrid(checks, makeMorph(points, cells), { { 9, 5, 3 }, spacing, first }, false, __LINE__);
  expectGrid(
    checks, makeMorph(cells, points), { { 9, 5, 3 }, spacing, { 0.0, -1.0, 0.0 } }, true, __LINE__);
  auto morph = makeMorph(points, cells);
  morph->SetDimensions(0, 2, 8);
  expectGrid(checks, morph, { { 9, 2, 8 }, { spacing[0], 3.5, 1.0 }, { first[0], 0.75, 0.5 } },
    false, __LINE__);

  // One domain, of points and of cells: that of the first to the bit.
  auto dual = makeBox({ { 8, 6, 3 }, { 1.0, 1.0, 2.0 }, { 0.0, 0.0, 0.0 } }, true);
  expectGrid(checks, makeMorph(points, dual), source, false, __LINE__);
  expectGrid(checks, makeMorph(dual, points), { { 8, 6, 3 }, { 1.0, 1.0, 2.0 }, { 0.0, 0.0, 0.0 } },
    true, __LINE__);
}

// Rounding must not add a layer of cells.
void checkRounding(Checks& checks)
{
  for (const double low : { 0.0, 0.1, 0.7 })
  {
    for (int shift = 1; shift <= 8; ++shift)
    {
      const Box source = { { 10, 1, 1 }, { 0.7, 1.0, 1.0 }, { low, 0.0, 0.0 } };
      const Box target = { { 10, 1, 1 }, { 0.7, 1.0, 1.0 }, { low + 0.7 * shift, 0.0, 0.0 } };
      auto morph = makeMorph(makeBox(source, true), makeBox(target, true));
      expectGrid(checks, morph,
        { { 10, 1, 1 }, { 0.07 * (10 + shift), 1.0, 1.0 }, { low, 0.0, 0.0 } }, true, __LINE__);
      morph->SetDimensions(10 + shift, 1, 1);
      expectGrid(checks, morph, { { 10 + shift, 1, 1 }, { 0.7, 1.0, 1.0 }, { low, 0.0, 0.0 } },
        true, __LINE__);
    }
  }
  const Box third = { { 3, 1, 1 }, { 1.0 / 3.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 } };
  const Box seventh = { { 7, 1, 1 }, { 1.0 / 7.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 } };
  expectGrid(
    checks, makeMorph(makeBox(third, true), makeBox(seventh, true)), seventh, true, __LINE__);
}

// However much finer one is, and whichever comes first. A box within the other one adds nothing.
void checkCells(Checks& checks)
{
  const Box large = { { 20, 20, 20 }, { 3.0, 3.0, 3.0 }, { -30.0, -30.0, -30.0 } };
  for (const double finest : { 1.0, 0.01, 1e-7 })
  {
    const Box small = { { 8, 8, 8 }, { finest, finest, finest }, { 0.0, 0.0, 0.0 } };
    expectGrid(
      checks, makeMorph(makeBox(large, true), makeBox(small, true)), large, true, __LINE__);
    expectGrid(
      checks, makeMorph(makeBox(small, true), makeBox(large, true)), large, true, __LINE__);
  }
  // Of all inputs of a barycenter, that with most cells counts, on the largest box or not.
  const Box most = { { 40, 30, 1 }, { 0.1, 0.1, 1.0 }, { 0.0, 0.0, 0.0 } };
  const Box longest = { { 12, 4, 1 }, { 1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 } };
  auto barycenter = makeBarycenter({ makeBox(longest, true), makeBox(most, true) });
  expectGrid(
    checks, barycenter, { { 60, 20, 1 }, { 0.2, 0.2, 1.0 }, { 0.0, 0.0, 0.0 } }, true, __LINE__);
  // Dimensions may say more.
  barycenter->SetDimensions(120, 40, 1);
  expectGrid(
    checks, barycenter, { { 120, 40, 1 }, { 0.1, 0.1, 1.0 }, { 0.0, 0.0, 0.0 } }, true, __LINE__);
  // Points need two along each axis.
  const Box thin = { { 50, 2, 1 }, { 1.0, 1.0, 1.0 }, { 0.5, 0.5, 0.0 } };
  const Box away = { { 50, 2, 1 }, { 1.0, 1.0, 1.0 }, { 50.5, 0.5, 0.0 } };
  expectGrid(checks, makeMorph(makeBox(thin, false), makeBox(away, false)),
    { { 50, 2, 1 }, { 2.0, 2.0, 1.0 }, { 1.0, 1.0, 0.0 } }, false, __LINE__);
}

// An axis that runs the other way: the place of the first cell is its highest end.
void checkNegativeSpacing(Checks& checks)
{
  const Box source = { { 8, 6, 1 }, { -1.0, 1.0, 1.0 }, { 0.0, 0.0, 0.0 } };
  const Box target = { { 5, 6, 1 }, { -0.5, 1.0, 1.0 }, { 2.0, 0.0, 0.0 } };
  expectGrid(checks, makeMorph(makeBox(source, true), makeBox(target, true)),
    { { 12, 4, 1 }, { -5.0 / 6.0, 5.0 / 3.0, 1.0 }, { 2.0, 0.0, 0.0 } }, true, __LINE__);
  auto morph = makeMorph(makeBox(target, false), makeBox(source, false));
  morph->SetDimensions(20, 6, 1);
  expectGrid(
    checks, morph, { { 20, 6, 1 }, { -0.4875, 1.0, 1.0 }, { 2.00625, 0.0, 0.0 } }, false, __LINE__);
}

// Inputs of one geometry have exactly that: the extent and the direction, too.
void checkSame(Checks& checks)
{
  const double turned[9] = { 0, -1, 0, 0.6, 0, 0.8, -0.8, 0, 0.6 };
  for (const bool cells : { true, false })
  {
    auto source = makeDensity({ 9, 7, 5 }, cells, bumpy);
    const int* e = source->GetExtent();
    source->SetExtent(e[0] + 2, e[1] + 2, e[2] - 3, e[3] - 3, e[4], e[5]);
    source->SetSpacing(0.3, 1.1, 2.0);
    source->SetOrigin(1.0, 2.0, 3.0);
    source->SetDirectionMatrix(turned);
    vtkNew<vtkImageData> target;
    target->DeepCopy(source);
    auto morph = makeMorph(source, target);
    checkInformation(checks, morph, __LINE__);
    vtkImageData* found = morph->GetDensity();
    CHECK(checks, std::equal(found->GetExtent(), found->GetExtent() + 6, source->GetExtent()));
    CHECK(checks, std::equal(found->GetOrigin(), found->GetOrigin() + 3, source->GetOrigin()));
    CHECK(checks, std::equal(found->GetSpacing(), found->GetSpacing() + 3, source->GetSpacing()));
    CHECK(checks, std::equal(turned, turned + 9, found->GetDirectionMatrix()->GetData()));

    // Other numbers on the same domain, and on a larger one.
    morph->SetDimensions(4, 0, 30);
    checkInformation(checks, morph, __LINE__);
    CHECK(checks, densityValues(morph).size() == 4u * 7 * 30);
    CHECK_NEAR(checks, massOf(morph->GetDensity()), massOf(source), 1e-11 * massOf(source));
    morph->SetDimensions(0, 0, 0);
    target->SetSpacing(0.3, 2.2, 2.0);
    checkInformation(checks, morph, __LINE__);
    CHECK(checks, densityValues(morph).size() == 7u * 11 * 4);
    CHECK(
      checks, std::equal(turned, turned + 9, morph->GetDensity()->GetDirectionMatrix()->GetData()));
  }
}

// Upstream has not run when information is asked for.
void checkUpstream(Checks& checks)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-9, 12, -3, 4, 5, 11);
  vtkNew<vtkRTAnalyticSource> target;
  target->SetWholeExtent(0, 20, -3, 4, 5, 11);
  vtkNew<vtkTransportInterpolator> morph;
  setSimplest(morph);
  morph->SetInputConnection(source->GetOutputPort());
  morph->SetTargetConnection(target->GetOutputPort());
  morph->SetNegativeValuesToClamp();
  checkInformation(checks, morph, __LINE__);
  CHECK(checks, densityValues(morph).size() == 26u * 7 * 6);
  vtkNew<vtkPointDataToCellData> toCells;
  toCells->SetInputConnection(source->GetOutputPort());
  toCells->PassPointDataOff();
  morph->SetInputConnection(toCells->GetOutputPort());
  morph->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "RTData");
  checkInformation(checks, morph, __LINE__);
  CHECK(checks, densityValues(morph).size() == 26u * 7 * 6);

  // An image filter downstream relies on what is published.
  vtkNew<vtkImageShrink3D> shrink;
  morph->SetInputConnection(source->GetOutputPort());
  morph->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "RTData");
  shrink->SetInputConnection(morph->GetOutputPort());
  shrink->SetShrinkFactors(2, 2, 1);
  shrink->Update();
  int dimensions[3];
  shrink->GetOutput()->GetDimensions(dimensions);
  CHECK(checks, dimensions[0] == 13 && dimensions[1] == 3 && dimensions[2] == 6);
}

} // namespace

int TestMorphGrid(int, char*[])
{
  return runChecks({ checkUnion, checkPoints, checkRounding, checkCells, checkNegativeSpacing,
    checkSame, checkUpstream });
}
