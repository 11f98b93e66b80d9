//! Uncertainty of the zero heights of depths, as a figure of a budget.

use taceva_metrology::budget::{Figure, Freedom};
use taceva_results::Samples;

/// Channel of depths, the only channel with a zero height.
const DEPTH: &str = "Pz";

/// Figure of `channel` from the column [`Samples::ZERO_U`]: the root mean square of the standard uncertainties of the zero heights.
///
/// A note states the number of depths that are measured from the first contact, to which the figure does not apply.
///
/// ```
/// use taceva_results::Samples;
/// let samples = Samples::read("sample,zero_u_mm,Pz\n1,0.001,0.4\n2,0.007,0.5\n3,,0.6\n")?;
/// let zero = taceva_report::depth_zero_figure(&samples, "Pz")?;
/// assert!((zero.u - 0.005).abs() < 1e-12);
/// assert_eq!((zero.n, zero.labels), (Some(2), Some([0.4, 0.5])));
/// assert!(zero.note.is_some_and(|note| note.starts_with("1 of 3 depths")));
/// assert!(taceva_report::depth_zero_figure(&samples, "Fz").is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A message if `channel` is not the depth, or if no sample has a fitted zero height.
pub fn depth_zero_figure(samples: &Samples, channel: &str) -> Result<Figure, String> {
    let labels = samples.channel(channel).filter(|_| channel == DEPTH);
    let labels = labels.ok_or_else(|| {
        format!("the samples have no depths (`{DEPTH}`), so there is no zero of depths")
    })?;
    let labelled = (0..samples.rows()).filter_map(|row| Some((row, labels.truth(row)?)));
    let labelled: Vec<(usize, f64)> = labelled.collect();
    let stated = labelled.iter().filter_map(|&(row, truth)| {
        let u_mm = samples.number(Samples::ZERO_U, row)?;
        Some((truth, u_mm))
    });
    let stated: Vec<(f64, f64)> = stated.collect();
    let Some((first, _)) = stated.first() else {
        return Err(format!(
            "no sample has `{}`: depths count from the first contact (`depth_from = \"surface\"` fits the surface)",
            Samples::ZERO_U
        ));
    };
    let squares: f64 = stated.iter().map(|(_, u_mm)| u_mm * u_mm).sum();
    let mut figure = Figure::new((squares / stated.len() as f64).sqrt(), Freedom::Infinite);
    figure.n = Some(stated.len() as u64);
    let ends = |[low, high]: [f64; 2], truth: f64| [low.min(truth), high.max(truth)];
    let truths = stated.iter().map(|(truth, _)| *truth);
    figure.labels = Some(truths.fold([*first; 2], ends));
    let (all, without) = (labelled.len(), labelled.len() - stated.len());
    figure.note = (without > 0).then(|| {
        format!("{without} of {all} depths count from the first contact, whose error is unknown")
    });
    Ok(figure)
}
