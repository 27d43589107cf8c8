// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportSampler
 * @brief sample a density with particles
 *
 * Moves points that fill the domain uniformly until they are distributed like the density, along
 * the rectified flow (equation 12) of Do, Coeurjolly, Memari and Bonneel, "Linear-Time Transport
 * with Rectified Flows", ACM Transactions on Graphics 44(4), 2025, doi:10.1145/3731147, or by the
 * optimal map (see Method). It stipples pictures and samples volumes.
 *
 * Input 0 is the density, a data set (see vtkDensityAlgorithm). Input 1, optional, is a vtkPointSet
 * of seeds in physical space, which replace SeedPattern. Seeds outside the domain are moved to its
 * border, with a warning that counts them. NaN or infinite coordinates are an error. Point data of
 * the seeds is passed to the particles, or as cell data to their paths.
 *
 * The output is a vtkPolyData with one vertex a particle, in the order of the seeds, and
 * - point data `SeedId` (the particle's number), `SeedPosition` (the position of its seed),
 *   `Displacement` (position - SeedPosition, active vectors), `Mass` (equal shares of the total
 *   mass);
 * - field data `TotalMass` (density times cell measure, summed) and `TransportCost` (the mean of
 *   |Displacement|^2, in physical units; with FlowTime 1 an upper bound on the squared
 *   2-Wasserstein distance between the uniform measure and the density, which was found 1 to 4 %
 *   above it for images), `MovedParticles` (those that ended in an empty cell and were put on the
 *   nearest mass; a warning counts them if they are at least one in a thousand), `OutsideSeeds`,
 *   and the input's field data.
 *
 * With Method Optimal or Certify, and FlowTime 1, there are also the field data
 * `TransportCostLowerBound` and `OptimalityGap` (see vtkTransportAlgorithm; the gap is that of
 * seeds that are uniform) and the point data `Slack`: how much more a pair of seed and particle
 * costs, halved, than the bound allows for there, at least 0, in squared physical units. Twice its
 * mean is about TransportCost less the bound. Paths have no Slack. Positions at other times are on
 * straight lines with Optimal. Particles of a SeedPattern are moved together, so that boxes of
 * cells get their shares of them; given seeds move each by itself.
 *
 * With OutputPaths, the output is one polyline a particle instead (see OutputPaths).
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(particles * steps)
 * for the flow. Memory: 104 bytes a particle for the output and, while it runs, 32 more in 2D, plus
 * the tables (see vtkTransportAlgorithm).
 *
 * With several MPI ranks, each rank has the particles at the positions that it owns. Without MPI,
 * piece 0 holds all particles.
 *
 * @warning If the seeds are not uniform in the domain, the particles do not follow the density.
 *
 * \code{.cpp}
 * vtkNew<vtkPNGReader> reader;
 * reader->SetFileName("photograph.png");
 * vtkNew<vtkTransportSampler> sampler;
 * sampler->SetInputConnection(reader->GetOutputPort());
 * sampler->InvertDensityOn(); // dark ink is mass
 * sampler->SetNumberOfParticles(40000);
 * sampler->Update();
 * vtkPolyData* particles = sampler->GetOutput();
 * double mass = particles->GetFieldData()->GetArray("TotalMass")->GetTuple1(0);
 * std::cout << particles->GetNumberOfPoints() << " particles share a mass of " << mass << "\n";
 * \endcode
 *
 * @sa vtkTransportMap vtkUniformSeedSource vtkTransportAlgorithm vtkDensityAlgorithm
 */
#ifndef vtkTransportSampler_h
#define vtkTransportSampler_h

#include "vtkPolyData.h"
#include "vtkRectifiedTransportDensitiesModule.h" // for the export macro
#include "vtkTransportAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;

class VTKRECTIFIEDTRANSPORTDENSITIES_EXPORT vtkTransportSampler : public vtkTransportAlgorithm
{
public:
  static vtkTransportSampler* New();
  vtkTypeMacro(vtkTransportSampler, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of particles, at least 1. Default 8192. It is exact unless SeedPattern is Lattice,
   * SamplesPerCell is used or seeds are given.
   */
  vtkSetMacro(NumberOfParticles, vtkIdType);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * The distribution of the uniform seeds that particles start from, even in physical lengths. Not
   * used if seeds are given. BlueNoise (default): even and irregular, without preferred directions.
   * Lattice: the centres of a grid of equal boxes, as near to NumberOfParticles as the aspect ratio
   * allows. Jittered: one random point in each of as many boxes of equal measure. LowDiscrepancy:
   * an additive recurrence. Random: independent.
   */
  vtkSetMacro(SeedPattern, int);
  vtkGetMacro(SeedPattern, int);
  void SetSeedPatternToBlueNoise() { this->SetSeedPattern(BLUE_NOISE); }
  void SetSeedPatternToLattice() { this->SetSeedPattern(LATTICE); }
  void SetSeedPatternToJittered() { this->SetSeedPattern(JITTERED); }
  void SetSeedPatternToLowDiscrepancy() { this->SetSeedPattern(LOW_DISCREPANCY); }
  void SetSeedPatternToRandom() { this->SetSeedPattern(RANDOM); }
  const char* GetSeedPatternAsString();
  ///@}

  ///@{
  /**
   * The seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random: any integer.
   * The same number gives the same seeds on every machine. Default 1.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  ///@{
  /**
   * If above 0: the number of seeds along each axis in every cell of the density, instead of
   * NumberOfParticles. 0 (default): not used. Only Lattice and Jittered use it.
   */
  vtkSetMacro(SamplesPerCell, int);
  vtkGetMacro(SamplesPerCell, int);
  ///@}

  ///@{
  /**
   * The time of the flow at the output, in [0,1]: 0 is the seeds, 1 (default) the density.
   */
  vtkSetMacro(FlowTime, double);
  vtkGetMacro(FlowTime, double);
  ///@}

  ///@{
  /**
   * On: instead of vertices, output one polyline a particle from its seed to its position at
   * FlowTime, with NumberOfSteps + 1 points (33 with 0 steps) at equal times, independent of the
   * integrator's steps. Point data: `SeedId`, `Time` and `Mass`, the mass of the particle at each
   * point of its path (the masses of one point of each path sum to TotalMass). Off by default.
   */
  vtkSetMacro(OutputPaths, vtkTypeBool);
  vtkGetMacro(OutputPaths, vtkTypeBool);
  vtkBooleanMacro(OutputPaths, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Give each particle the values of the density's image at its position, as point arrays with the
   * same names. Cell arrays give the cell's value; point arrays are interpolated linearly. Arrays
   * whose names the particles or the seeds already have, ghost arrays, ids of points
   * (vtkIdTypeArray) and global ids are left out. Not with OutputPaths. On by default.
   */
  vtkSetMacro(SampleArrays, vtkTypeBool);
  vtkGetMacro(SampleArrays, vtkTypeBool);
  vtkBooleanMacro(SampleArrays, vtkTypeBool);
  ///@}

  /**
   * Set the seeds (input 1), as the output of another filter. nullptr: no seeds.
   */
  void SetSeedsConnection(vtkAlgorithmOutput* seeds) { this->SetInputConnection(1, seeds); }

  /**
   * The same, as a data object.
   */
  void SetSeedsData(vtkDataObject* seeds) { this->SetInputData(1, seeds); }

  /**
   * The particles or their paths.
   */
  vtkPolyData* GetOutput() { return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0)); }

protected:
  vtkTransportSampler();
  ~vtkTransportSampler() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkIdType NumberOfParticles = 8192;
  int SeedPattern = BLUE_NOISE;
  int RandomSeed = 1;
  int SamplesPerCell = 0;
  double FlowTime = 1.0;
  vtkTypeBool OutputPaths = false;
  vtkTypeBool SampleArrays = true;

private:
  vtkTransportSampler(const vtkTransportSampler&) = delete;
  void operator=(const vtkTransportSampler&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
