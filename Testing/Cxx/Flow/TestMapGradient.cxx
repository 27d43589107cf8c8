// SPDX-License-Identifier: BSD-3-Clause
// Divergence and Jacobian determinant against vtkGradientFilter on Displacement, which takes the
// same differences, at the border too; and against the densities that the maps connect.
#include "MapTest.h"

#include "vtkGradientFilter.h"
#include "vtkMath.h"

namespace
{

// `axes` are those of the image: outside of its plane nothing is known of the gradient.
void checkGradient(Checks& checks, vtkImageData* image, const std::vector<int>& axes, int line)
{
  const bool cells = image->GetCellData()->GetScalars() != nullptr;
  for (const int direction : { 0, 1 })
  {
    vtkNew<vtkTransportMap> map;
    map->SetInputData(image);
    map->SetDirection(direction);
    vtkNew<vtkGradientFilter> gradient;
    gradient->SetInputConnection(map->GetOutputPort());
    gradient->SetInputScalars(
      cells ? vtkDataObject::FIELD_ASSOCIATION_CELLS : vtkDataObject::FIELD_ASSOCIATION_POINTS,
      "Displacement");
    gradient->SetResultArrayName("Gradient");
    gradient->Update();
    auto* output = vtkImageData::SafeDownCast(gradient->GetOutput());
    const Values gradients = imageValues(output, "Gradient");
    const Values divergences = imageValues(output, "Divergence");
    const Values determinants = imageValues(output, "JacobianDeterminant");
    CHECK(checks, !divergences.empty() && gradients.size() == 9 * divergences.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < divergences.size() && gradients.size() >= 9 * (i + 1); ++i)
    {
      double jacobian[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
      double divergence = 0.0;
      for (const int r : axes)
      {
        divergence += gradients[9 * i + 4 * r];
        for (const int c : axes)
        {
          jacobian[r][c] += gradients[9 * i + 3 * r + c];
        }
      }
      worst = std::max({ worst, std::abs(divergences[i] - divergence),
        std::abs(determinants[i] - vtkMath::Determinant3x3(jacobian)) });
    }
    checks.Near(worst, 0.0, 1e-10, "the gradient's divergence and determinant", line);
  }
}

void checkAgainstFilter(Checks& checks)
{
  for (const bool cells : { true, false })
  {
    const int more = cells ? 1 : 0;
    const auto place = [](vtkImageData* image) {
      image->SetSpacing(0.5, 2.0, 1.25);
      image->SetOrigin(4.0, -1.0, 9.0);
      return image;
    };
    const int n = 12 + more;
    const int m = 9 + more;
#ifndef RECTIFIEDTRANSPORT_VTK_HAS_FLAT_GRADIENTS
    if (cells)
    {
      checkGradient(checks, place(makeImage(n, m, 7 + more, cells, bumpy)), { 0, 1, 2 }, __LINE__);
      continue;
    }
#endif
    checkGradient(checks, place(makeImage(n, m, 7 + more, cells, bumpy)), { 0, 1, 2 }, __LINE__);
    checkGradient(checks, place(makeImage(n, m, 1, cells, bumpy)), { 0, 1 }, __LINE__);
    checkGradient(checks, place(makeImage(n, 1, m, cells, bumpy)), { 0, 2 }, __LINE__);
    checkGradient(checks, place(makeImage(1, n, m, cells, bumpy)), { 1, 2 }, __LINE__);
    checkGradient(checks, place(makeImage(n, 1, 1, cells, bumpy)), { 0 }, __LINE__);
  }
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double rotation[9] = { c, -s, 0, s * c, c * c, -s, s * s, s * c, c };
  const double sheer[9] = { 1, 0.5, 0, 0, 1, 0.25, 0, 0, 1 };
  for (const double* matrix : { rotation, sheer })
  {
    auto image = makeImage(10, 9, 7, false, bumpy);
    image->SetSpacing(0.5, 2.0, 1.25);
    image->SetDirectionMatrix(matrix);
    checkGradient(checks, image, { 0, 1, 2 }, __LINE__);
  }
}

// Forward, det J f(T(x)) is the mean of f; backward, f / det J is. The finer, the nearer.
double spread(int n, int direction)
{
  const auto f = smoothDensity(n, n);
  vtkNew<vtkTransportMap> map;
  map->SetInputData(makeImage(n, n, 1, false, f));
  map->SetDirection(direction);
  map->SetNumberOfSteps(128);
  map->Update();
  const Values determinants = imageValues(map->GetOutput(), "JacobianDeterminant");
  const Values displacement = imageValues(map->GetOutput(), "Displacement");
  const double mean = fieldValue(map->GetOutput(), "TotalMass") / (n * n);
  double squares = 0.0;
  for (int i = 0; i < n * n; ++i)
  {
    double density = f(i);
    if (direction == 0)
    {
      // Bilinear, as the density is smooth.
      const double limit = n - 1.0001;
      const double x = std::min(std::max(i % n + displacement[3 * i], 0.0), limit);
      const double y = std::min(std::max(i / n + displacement[3 * i + 1], 0.0), limit);
      const int u = static_cast<int>(x);
      const int v = static_cast<int>(y);
      const auto at = [&](int p, int q) { return f((v + q) * n + u + p); };
      density = (1 - y + v) * ((1 - x + u) * at(0, 0) + (x - u) * at(1, 0)) +
        (y - v) * ((1 - x + u) * at(0, 1) + (x - u) * at(1, 1));
    }
    const double part =
      (direction == 0 ? density * determinants[i] : density / determinants[i]) / mean;
    squares += (part - 1.0) * (part - 1.0);
  }
  return std::sqrt(squares / (n * n));
}

void checkMeasure(Checks& checks)
{
  for (const int direction : { 0, 1 })
  {
    const double coarse = spread(32, direction);
    const double fine = spread(128, direction);
    CHECK_NEAR(checks, coarse, 0.0, 0.05);
    CHECK_NEAR(checks, fine, 0.0, 0.5 * coarse);
  }
}

} // namespace

int TestMapGradient(int, char*[])
{
  return runChecks({ checkAgainstFilter, checkMeasure });
}
