//! Distributions of a normal sample, to about 14 digits: probabilities of both tails, and quantiles.
//!
//! Only + − × ÷ and √ are used, which IEEE 754 rounds the same everywhere. An argument outside the domain gives NaN.
//!
//! ```
//! use taceva_metrics::distributions::{chi_square, f_ratio, normal, student_t};
//! assert!((student_t::quantile(0.975, 16.0) - 2.119_905_299_221_254_7).abs() < 1e-14);
//! assert!((chi_square::quantile(0.95, 1.0) - 3.841_458_820_694_126).abs() < 1e-14);
//! assert!((f_ratio::above(3.554_557_145_661_789, 2.0, 18.0) - 0.05).abs() < 1e-15);
//! assert!((normal::below(1.96) - 0.975_002_104_851_779_6).abs() < 1e-15);
//! ```
//!
//! # Reference
//! Abramowitz and Stegun, Handbook of Mathematical Functions (1964), chapter 26; Loader, Fast and accurate computation of binomial
//! probabilities (2000).

mod beta;
pub mod chi_square;
mod deviance;
pub mod f_ratio;
mod gamma;
pub mod noncentral_t;
pub mod normal;
pub mod student_t;
mod tails;
