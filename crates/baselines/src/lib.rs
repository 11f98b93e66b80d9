#![doc = include_str!("../README.md")]

#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod adapter;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod guard;
#[cfg(feature = "linfa")]
mod linfa;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod predictor;
#[cfg(feature = "smartcore")]
mod smartcore;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod span;
#[cfg(any(feature = "linfa", feature = "smartcore"))]
mod support_vector;

use taceva_models::LibraryModel;

/// Every model of linfa and smartcore that this build has, the plainest of each first; none without the features `linfa` and `smartcore`.
///
/// ```
/// use taceva_models::Models;
/// let models = Models::builtin().with_libraries(taceva_baselines::all());
/// assert_eq!(models.find("linfa/pls").is_ok(), cfg!(feature = "linfa"));
/// ```
pub fn all() -> impl Iterator<Item = &'static LibraryModel> {
    #[cfg(feature = "linfa")]
    let of_linfa = linfa::ALL;
    #[cfg(not(feature = "linfa"))]
    let of_linfa: &[&LibraryModel] = &[];
    #[cfg(feature = "smartcore")]
    let of_smartcore = smartcore::ALL;
    #[cfg(not(feature = "smartcore"))]
    let of_smartcore: &[&LibraryModel] = &[];
    of_linfa.iter().chain(of_smartcore).copied()
}
