// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkUniformSeedSource
 * @brief   points that are uniform in a rectangle or a box
 *
 * A source of seeds for vtkTransportSampler, and of uniform samples in general. The output is a
 * vtkPolyData with double points and one vertex a point. Cost: O(points); blue noise takes less
 * than 10 ms for 100,000 points, 0.05 s in a strip that is a few points thick. Memory: 40 bytes a
 * point and, while it runs, 16 more in 2D, 50 more for blue noise in such a strip.
 *
 * Each piece has a range of the points by their numbers: all MPI ranks together have the points of
 * one rank, in the same order. Blue noise takes the time of all points even for a piece. Memory is
 * only for the piece.
 *
 * Bounds that are not finite or not in ascending order, a Dimension other than 2 and 3, and a
 * NumberOfPoints below 1 are errors. The output is then empty.
 *
 * \code{.cpp}
 * vtkNew<vtkUniformSeedSource> seeds;
 * seeds->SetBounds(0, 4, 0, 3, 0, 0);
 * seeds->SetNumberOfPoints(12000);
 * seeds->SetPatternToJittered();
 * vtkNew<vtkTransportSampler> sampler;
 * sampler->SetInputConnection(reader->GetOutputPort());
 * sampler->SetSeedsConnection(seeds->GetOutputPort());
 * sampler->Update();
 * vtkPolyData* particles = sampler->GetOutput(); // particle i comes from point i of the seeds
 * std::cout << particles->GetNumberOfPoints() << " particles\n";
 * \endcode
 *
 * @sa vtkTransportSampler
 */
#ifndef vtkUniformSeedSource_h
#define vtkUniformSeedSource_h

#include "vtkCollectiveAlgorithm.h"
#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro

VTK_ABI_NAMESPACE_BEGIN
class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkUniformSeedSource : public vtkCollectiveAlgorithm
{
public:
  static vtkUniformSeedSource* New();
  vtkTypeMacro(vtkUniformSeedSource, vtkCollectiveAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The box (xmin, xmax, ymin, ymax, zmin, zmax) that the points fill. Bounds are finite, each
   * upper bound is above its lower bound; in two dimensions those of z may be equal. Default 0 1 0
   * 1 0 1.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * 2 (default): points in the plane z = zmin. 3: points in the box.
   */
  vtkSetMacro(Dimension, int);
  vtkGetMacro(Dimension, int);
  ///@}

  ///@{
  /**
   * The number of points, at least 1. Default 8192. It is exact unless Pattern is Lattice: then as
   * near as a grid of the box's aspect ratio allows.
   */
  vtkSetMacro(NumberOfPoints, vtkIdType);
  vtkGetMacro(NumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * How the points are distributed. BlueNoise (default): even and irregular, without preferred
   * directions. Lattice: the centres of a grid of equal boxes. Jittered: one random point in each
   * of as many boxes of equal measure. LowDiscrepancy: an additive recurrence. Random: independent.
   */
  vtkSetMacro(Pattern, int);
  vtkGetMacro(Pattern, int);
  void SetPatternToBlueNoise() { this->SetPattern(BLUE_NOISE); }
  void SetPatternToLattice() { this->SetPattern(LATTICE); }
  void SetPatternToJittered() { this->SetPattern(JITTERED); }
  void SetPatternToLowDiscrepancy() { this->SetPattern(LOW_DISCREPANCY); }
  void SetPatternToRandom() { this->SetPattern(RANDOM); }
  const char* GetPatternAsString();
  ///@}

  ///@{
  /**
   * The seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random: any integer.
   * The same number gives the same points on every machine. Default 1.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  /**
   * The points, each a vertex.
   */
  vtkPolyData* GetOutput() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkUniformSeedSource();
  ~vtkUniformSeedSource() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Bounds[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  int Dimension = 2;
  vtkIdType NumberOfPoints = 8192;
  int Pattern = BLUE_NOISE;
  int RandomSeed = 1;

private:
  vtkUniformSeedSource(const vtkUniformSeedSource&) = delete;
  void operator=(const vtkUniformSeedSource&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
