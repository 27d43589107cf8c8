// SPDX-License-Identifier: BSD-3-Clause
// Weights of the variable-step Adams-Bashforth-Moulton method of order 3.
#ifndef RectifiedTransport_AdamsWeights_h
#define RectifiedTransport_AdamsWeights_h

// The times of the two velocities before the newest one, minus its time, over the step's length:
// first = alpha and second = beta, both negative, -1 and -2 for even steps. In units of the
// step, which then is [0, 1], a weight is the integral over the step of the Lagrange polynomial of
// its velocity: through the places 0, alpha, beta in the predictor (newest velocity first), and
// through 1, 0, alpha in the corrector (that at the step's end first). Each three sum to 1.
RT_FUNCTION void predictorWeights(
  double first, double second, double* weight0, double* weight1, double* weight2)
{
  *weight0 = (1.0 / 3.0 - (first + second) / 2.0 + first * second) / (first * second);
  *weight1 = (1.0 / 3.0 - second / 2.0) / (first * (first - second));
  *weight2 = (1.0 / 3.0 - first / 2.0) / (second * (second - first));
}

RT_FUNCTION void correctorWeights(double first, double* weight0, double* weight1, double* weight2)
{
  *weight0 = (1.0 / 3.0 - first / 2.0) / (1.0 - first);
  *weight1 = (1.0 / 3.0 - (1.0 + first) / 2.0 + first) / first;
  *weight2 = -1.0 / (6.0 * first * (first - 1.0));
}

RT_FUNCTION void adamsWeights(double first, double second, double* predictor, double* corrector)
{
  predictorWeights(first, second, &predictor[0], &predictor[1], &predictor[2]);
  correctorWeights(first, &corrector[0], &corrector[1], &corrector[2]);
}

#endif
