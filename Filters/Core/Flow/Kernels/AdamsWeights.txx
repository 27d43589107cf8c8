// SPDX-License-Identifier: BSD-3-Clause
// Weights of the variable-step Adams-Bashforth-Moulton method of order 3. To be included in an
// anonymous namespace.

// The times of the two velocities before the newest one, minus its time, over the step's length:
// first = alpha and second = beta, both negative, -1 and -2 for even steps. In units of the
// step, which then is [0, 1], a weight is the integral over the step of the Lagrange polynomial of
// its velocity: through the places 0, alpha, beta in the predictor (newest velocity first), and
// through 1, 0, alpha in the corrector (that at the step's end first). Each three sum to 1.
inline void adamsWeights(
  double first, double second, double (&predictor)[3], double (&corrector)[3])
{
  predictor[0] = (1.0 / 3.0 - (first + second) / 2.0 + first * second) / (first * second);
  predictor[1] = (1.0 / 3.0 - second / 2.0) / (first * (first - second));
  predictor[2] = (1.0 / 3.0 - first / 2.0) / (second * (second - first));
  corrector[0] = (1.0 / 3.0 - first / 2.0) / (1.0 - first);
  corrector[1] = (1.0 / 3.0 - (1.0 + first) / 2.0 + first) / first;
  corrector[2] = -1.0 / (6.0 * first * (first - 1.0));
}
