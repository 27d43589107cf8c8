// SPDX-License-Identifier: BSD-3-Clause
// Images that one blend may have: in planes and with directions that are the same up to rounding,
// and not beyond it.
#include "BlendTest.h"

#include "vtkMatrix3x3.h"

#include <algorithm>
#include <cmath>

namespace
{

// 30 x 20 cells in the plane z = 3.
vtkSmartPointer<vtkImageData> makePlane(double longest)
{
  auto image = makeDensity({ 30, 20, 1 }, true, bumpy);
  image->SetSpacing(longest / 30.0, longest / 50.0, 1.0);
  image->SetOrigin(0.0, 0.0, 3.0);
  return image;
}

// Whether a morph runs; else its one error begins with the words.
bool isAccepted(
  Checks& checks, vtkImageData* source, vtkImageData* target, const std::string& words, int line)
{
  auto morph = makeMorph(source, target);
  morph->SetDimensions(6, 5, 1);
  Messages messages(morph);
  morph->Update();
  if (messages.Errors.empty())
  {
    checks.That(!isEmpty(morph), "an output", line);
    return true;
  }
  checks.That(messages.Errors.size() == 1 && contains(messages.Errors[0], words), words.c_str(),
    line, messages.Errors[0]);
  checks.That(isEmpty(morph), "no output", line);
  return false;
}

// Single precision is rounding, by the longest side of both; above and below.
void checkPlanes(Checks& checks)
{
  for (const double longest : { 1e-3, 1.0, 500.0 })
  {
    auto source = makePlane(longest);
    for (const double share : { 1.0, 0.1 })
    {
      auto target = makePlane(share * longest);
      for (const double sign : { 1.0, -1.0 })
      {
        const auto moved = [&](double off) {
          target->SetOrigin(0.0, 0.0, 3.0 + sign * off * longest);
        };
        for (const bool swap : { false, true })
        {
          vtkImageData* from = swap ? target : source;
          vtkImageData* to = swap ? source : target;
          moved(1e-7);
          CHECK(checks, isAccepted(checks, from, to, "", __LINE__));
          moved(1e-5);
          CHECK(checks, !isAccepted(checks, from, to, "must lie in one plane", __LINE__));
        }
      }
    }
  }
}

// Turned by an angle about an axis of the image or across it.
void checkDirections(Checks& checks)
{
  auto source = makePlane(30.0);
  source->SetOrigin(0.0, 0.0, 0.0);
  auto target = makePlane(30.0);
  target->SetOrigin(0.0, 0.0, 0.0);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto turn = [&](double angle) {
      double matrix[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
      const std::size_t a = (axis + 1) % 3;
      const std::size_t b = (axis + 2) % 3;
      matrix[3 * a + a] = matrix[3 * b + b] = std::cos(angle);
      matrix[3 * a + b] = -std::sin(angle);
      matrix[3 * b + a] = std::sin(angle);
      target->SetDirectionMatrix(matrix);
    };
    for (const double sign : { 1.0, -1.0 })
    {
      const std::string words = "have different direction matrices";
      for (const double angle : { 1e-10, 1e-8, 9e-7 })
      {
        turn(sign * angle);
        CHECK(checks, isAccepted(checks, source, target, words, __LINE__));
      }
      turn(sign * 1.1e-6);
      CHECK(checks, !isAccepted(checks, source, target, words, __LINE__));
      turn(sign * 0.1);
      CHECK(checks, !isAccepted(checks, source, target, words, __LINE__));
    }
  }
  // One element alone, below and above that of the other.
  for (const double stretch : { 0.9, 1.1 })
  {
    double matrix[9] = { stretch, 0, 0, 0, 1, 0, 0, 0, 1 };
    target->SetDirectionMatrix(matrix);
    CHECK(checks, !isAccepted(checks, source, target, "different direction matrices", __LINE__));
  }
}

// The density of a blend.
struct Blended
{
  explicit Blended(vtkTransportBlend* blend)
  {
    blend->Update();
    this->Image->DeepCopy(blend->GetDensity());
    this->Density = densityValues(blend);
  }

  vtkNew<vtkImageData> Image;
  Values Density;
};

// Has the extent, the origin, the spacing and the directions of another one, bit by bit.
bool isOn(vtkImageData* image, vtkImageData* other)
{
  bool same = std::equal(image->GetExtent(), image->GetExtent() + 6, other->GetExtent());
  same = same && std::equal(image->GetOrigin(), image->GetOrigin() + 3, other->GetOrigin());
  same = same && std::equal(image->GetSpacing(), image->GetSpacing() + 3, other->GetSpacing());
  const double* directions = image->GetDirectionMatrix()->GetData();
  return same && std::equal(directions, directions + 9, other->GetDirectionMatrix()->GetData());
}

// What single precision, or eight digits of text, make of a matrix, an origin and a spacing is one
// geometry with them, far from the origin, too: that of the first input.
void checkRounded(Checks& checks)
{
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  const double turned[9] = { c, -s * c, s * s, s, c * c, -c * s, 0.0, s, c };
  const auto digits = [](double x) { return std::round(x * 1e8) * 1e-8; };
  const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  for (const bool cells : { true, false })
  {
    for (const double away : { 0.0, 1234.5678901 })
    {
      auto source = makeDensity({ 12, 9, 7 }, cells, smoothDensity(12, 9));
      source->SetDirectionMatrix(turned);
      source->SetOrigin(away + 0.123456789, -away, 0.5 * away);
      source->SetSpacing(0.7123456789, 0.3, 1.0 / 3.0);
      auto target = makeDensity({ 12, 9, 7 }, cells, otherDensity(12, 9));
      const auto rounded = [&](const auto& round, const auto& roundPlace) {
        double matrix[9];
        std::transform(turned, turned + 9, matrix, round);
        target->SetDirectionMatrix(matrix);
        double place[6];
        std::transform(source->GetOrigin(), source->GetOrigin() + 3, place, roundPlace);
        std::transform(source->GetSpacing(), source->GetSpacing() + 3, place + 3, roundPlace);
        target->SetOrigin(place);
        target->SetSpacing(place + 3);
      };
      const auto exact = [](double x) { return x; };
      rounded(exact, exact);
      const Blended expected(makeMorph(source, target));
      CHECK(checks, isOn(expected.Image, source));
      const auto compare = [&](int line) {
        const Blended morph(makeMorph(source, target));
        checks.That(isOn(morph.Image, source), "on the source's grid", line);
        checks.Near(largestDifference(morph.Density, expected.Density), 0.0, 0.02, "alike", line);
        const Blended back(makeMorph(target, source));
        checks.That(isOn(back.Image, target), "on the target's grid", line);
        const Blended mean(makeBarycenter({ source, target, source }));
        checks.That(isOn(mean.Image, source), "on the first one's grid", line);
      };
      rounded(single, exact);
      compare(__LINE__);
      rounded(digits, exact);
      compare(__LINE__);
      rounded(single, single);
      compare(__LINE__);
    }
  }
}

// Spacings that differ by rounding make no spacing of their own; beyond it the box holds both
// domains, with as many cells.
void checkSpacings(Checks& checks)
{
  for (const double off : { 1e-10, -1e-10, 3e-7, -3e-7, 1e-5, -1e-5 })
  {
    auto source = makePlane(30.0);
    auto target = makePlane(30.0 * (1.0 + off));
    auto morph = makeMorph(source, target);
    morph->Update();
    vtkImageData* image = morph->GetDensity();
    const bool isRounding = std::abs(off) < 1e-6;
    CHECK(checks, image->GetDimensions()[0] == 31);
    const double end = isRounding ? 30.0 : 30.0 * std::max(1.0, 1.0 + off);
    CHECK_NEAR(checks, image->GetBounds()[1], end, 1e-9);
    CHECK(checks, !isRounding || image->GetSpacing()[0] == source->GetSpacing()[0]);
  }
  // Of two resolutions, one of which is in single precision.
  for (const double off : { 0.0, 6e-8, -6e-8 })
  {
    auto coarse = makeDensity({ 128, 8, 1 }, true, bumpy);
    coarse->SetSpacing(0.2 * (1.0 + off), 0.2, 1.0);
    auto fine = makeDensity({ 256, 16, 1 }, true, bumpy);
    fine->SetSpacing(0.1, 0.1, 1.0);
    for (const bool swap : { false, true })
    {
      auto morph = makeMorph(swap ? fine : coarse, swap ? coarse : fine);
      morph->Update();
      CHECK(checks, morph->GetDensity()->GetDimensions()[0] == 257);
    }
  }
}

// Axes may be far from right angles.
void checkSheared(Checks& checks)
{
  for (const double height : { 0.5, 1e-4 })
  {
    const double sheared[9] = { 1, 1, 0, 0, height, 0, 0, 0, 1 };
    auto source = makePlane(30.0);
    source->SetDirectionMatrix(sheared);
    auto target = makePlane(60.0);
    target->SetDirectionMatrix(sheared);
    CHECK(checks, isAccepted(checks, source, target, "", __LINE__));
  }
}

} // namespace

int TestCommonGrid(int, char*[])
{
  return runChecks({ checkPlanes, checkDirections, checkRounded, checkSpacings, checkSheared });
}
