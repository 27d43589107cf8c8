// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransportSampler
 * @brief   sample a density of an image with particles
 *
 * Moves points that are spread uniformly over the domain of an image so that in the end they are
 * distributed like its density, along the rectified flow (equation 12) of Do, Coeurjolly, Memari
 * and Bonneel, "Linear-Time Transport with Rectified Flows", ACM Transactions on Graphics 44(4),
 * 2025, doi:10.1145/3731147. It stipples pictures and samples volumes.
 *
 * Input 0 is the density, a data set (see vtkDensityAlgorithm). Input 1 is optional: a
 * vtkPointSet of seeds in physical space, in place of SeedPattern. Seeds outside the domain are
 * moved to its border, with one warning that counts them; NaN or infinite ones are an error. Point
 * data of the seeds is passed on, to the particles or as cell data to their paths.
 *
 * The output is a vtkPolyData with one vertex a particle, in the order of the seeds, and
 * - point data `SeedId` (the particle's number), `SeedPosition` (that of its seed), `Displacement`
 *   (position - SeedPosition, active vectors), `Mass` (an equal share of the total mass each);
 * - field data `TotalMass` (density times cell measure, summed) and `TransportCost` (the mean of
 *   |Displacement|^2, in physical units; where FlowTime is 1 an upper bound on the squared
 *   2-Wasserstein distance between the uniform measure and the density, which was found 2 to 14 %
 *   above it), beside the input's own field data.
 *
 * With OutputPaths the output is one polyline a particle instead, see there.
 *
 * Cost: O(cells) for the tables, which are kept until the density changes, and O(particles * steps)
 * for the flow. Memory: 104 bytes a particle for the output, and while it runs 32 more in 2D,
 * beside the tables (see vtkTransportAlgorithm).
 *
 * On several ranks of MPI each has the particles of its places; in other programs piece 0 holds all
 * of them.
 *
 * @warning Particles of seeds that are not uniform in the domain do not follow the density.
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

#include "vtkTransportAlgorithm.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithmOutput;
class vtkPolyData;

class VTKRECTIFIEDTRANSPORT_EXPORT vtkTransportSampler : public vtkTransportAlgorithm
{
public:
  static vtkTransportSampler* New();
  vtkTypeMacro(vtkTransportSampler, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What SeedPattern may be.
   */
  enum SeedPatternType
  {
    BLUE_NOISE = 0,
    LATTICE = 1,
    JITTERED = 2,
    LOW_DISCREPANCY = 3,
    RANDOM = 4
  };

  ///@{
  /**
   * The number of particles, at least 1. Default 8192. The output has exactly as many, except where
   * SeedPattern is Lattice, SamplesPerCell is used or seeds are given.
   */
  vtkSetMacro(NumberOfParticles, vtkIdType);
  vtkGetMacro(NumberOfParticles, vtkIdType);
  ///@}

  ///@{
  /**
   * How the uniform seeds that particles start from are distributed, evenly in lengths;
   * not used where seeds are given. BlueNoise (default): even and irregular, without preferred
   * directions. Lattice: the centres of a grid of equal boxes, whose number is as near to
   * NumberOfParticles as the aspect ratio allows. Jittered: one at random in each of as many boxes
   * of equal measure. LowDiscrepancy: an additive recurrence. Random: independent.
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
   * The seed of the random numbers of BlueNoise, Jittered, LowDiscrepancy and Random: any integer;
   * the same one gives the same seeds on every machine. Default 1.
   */
  vtkSetMacro(RandomSeed, int);
  vtkGetMacro(RandomSeed, int);
  ///@}

  ///@{
  /**
   * For Lattice and Jittered, above 0: the number of seeds along each axis in every cell of the
   * density, instead of NumberOfParticles. 0 (default): not used. The other patterns do not use it.
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
   * On: instead of vertices, one polyline a particle from its seed to its position at FlowTime,
   * with NumberOfSteps + 1 points at equal intervals of time, whatever the integrator's steps are.
   * Point data: `SeedId`, `Time` and `Mass`, the mass of the particle at each point of its path
   * (the masses of one point of each path sum to TotalMass). Off by default.
   */
  vtkSetMacro(OutputPaths, vtkTypeBool);
  vtkGetMacro(OutputPaths, vtkTypeBool);
  vtkBooleanMacro(OutputPaths, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Give each particle the values of the density's image where it is, as point arrays of their
   * names: those of cell arrays are the cell's, those of point arrays linear between the points.
   * Arrays whose names the particles or the seeds have already are left out, and so are ghost
   * arrays, ids of points (vtkIdTypeArray) and global ids. Not with OutputPaths. On by default.
   */
  vtkSetMacro(SampleArrays, vtkTypeBool);
  vtkGetMacro(SampleArrays, vtkTypeBool);
  vtkBooleanMacro(SampleArrays, vtkTypeBool);
  ///@}

  /**
   * Set the seeds (input 1), as the output of another filter. nullptr: none.
   */
  void SetSeedsConnection(vtkAlgorithmOutput* seeds);

  /**
   * The same, as a data object.
   */
  void SetSeedsData(vtkDataObject* seeds);

  /**
   * The particles or their paths.
   */
  vtkPolyData* GetOutput();

protected:
  vtkTransportSampler();
  ~vtkTransportSampler() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkIdType NumberOfParticles;
  int SeedPattern;
  int RandomSeed;
  int SamplesPerCell;
  double FlowTime;
  vtkTypeBool OutputPaths;
  vtkTypeBool SampleArrays;

private:
  vtkTransportSampler(const vtkTransportSampler&) = delete;
  void operator=(const vtkTransportSampler&) = delete;
};
VTK_ABI_NAMESPACE_END

#endif
