#pragma once
// Functions for samples, from +, -, *, / and sqrt alone. IEEE 754 fixes these to the last bit, while exp and
// log of a C library differ between versions and processors. So a seed gives the same samples on every
// machine.

namespace talus::formats::sweep {

double portableExp(double x);       ///< relative error below 1e-15; 0 below -745, infinite above 709.8
double portableLog(double x);       ///< relative error below 1e-15. \pre x > 0, finite
double portableLogGamma(double x);  ///< absolute error below 1e-14 (1 + |result|). \pre x > 0

/// P(X < x) of the standard normal distribution; relative error below 1e-13, in the lower tail too.
double normalCdf(double x);

/// Regularised incomplete beta function I_x(a, b); absolute error below 1e-13. \pre a, b > 0
double betaCdf(double a, double b, double x);

}  // namespace talus::formats::sweep
