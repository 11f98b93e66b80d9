//! Maximum-likelihood choice of the ratio of noise variance to signal variance.

use faer::Mat;

use crate::linalg::Spectrum;

/// Candidate ratios of noise variance to signal variance, ascending.
pub(super) fn ratios() -> Vec<f64> {
    (0..=40)
        .map(|step| 10_f64.powf(-8.0 + 0.25 * f64::from(step)))
        .collect()
}

/// Maximum-likelihood settings of one channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Likeliest {
    /// −2 log likelihood of the labels, up to a constant.
    pub(super) cost: f64,
    /// Noise-to-signal ratio λ.
    pub(super) ratio: f64,
    /// Signal variance s² of the scaled labels.
    pub(super) signal: f64,
}

/// Finds the likeliest noise ratio and signal variance for each column of centred `labels`, given the spectrum of the centred features.
pub(super) fn likeliest(
    spectrum: &Spectrum<'_, '_>,
    rotated: &Mat<f64>,
    labels: &Mat<f64>,
) -> Vec<Likeliest> {
    let eigenvalues = spectrum.eigenvalues();
    let samples = labels.nrows() as f64;
    let unseen = samples - eigenvalues.len() as f64;
    let of = |channel: usize| {
        let column = labels.col_as_slice(channel);
        let total: f64 = column.iter().map(|label| label * label).sum();
        // Squared labels along the eigenvectors of the samples.
        let along: Vec<f64> = eigenvalues
            .iter()
            .zip(rotated.col_as_slice(channel))
            .map(|(&eigenvalue, rotated)| match spectrum.spans_samples() {
                true => rotated * rotated,
                false if eigenvalue > spectrum.noise() => rotated * rotated / eigenvalue,
                false => 0.0,
            })
            .collect();
        let rest = (total - along.iter().sum::<f64>()).max(0.0);
        let candidates = ratios().into_iter().map(|ratio| {
            let seen = along.iter().zip(eigenvalues);
            let inside: f64 = seen.map(|(along, value)| along / (value + ratio)).sum();
            let signal = (inside + rest / ratio) / samples;
            let volume: f64 = eigenvalues.iter().map(|value| (value + ratio).ln()).sum();
            let cost = if signal > 0.0 {
                samples * signal.ln() + volume + unseen * ratio.ln()
            } else {
                // All labels are equal, so all settings are equally likely.
                0.0
            };
            Likeliest {
                cost,
                ratio,
                signal,
            }
        });
        let best = candidates.reduce(|best, next| if next.cost <= best.cost { next } else { best });
        best.expect("there are ratios to try")
    };
    (0..labels.ncols()).map(of).collect()
}
