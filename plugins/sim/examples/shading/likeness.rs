//! Similarity of two pictures.

use super::press::Picture;

/// Three measures of similarity, over all pixels and colours.
pub(crate) struct Likeness {
    /// Mean absolute difference over pixels and colours, DN.
    l1_dn: f64,
    /// Peak signal-to-noise ratio, 20 log₁₀(255 / RMS difference), in dB.
    psnr_db: f64,
    /// Mean structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004): Gaussian window of σ = 1.5 pixels cut at 5, K₁ = 0.01, K₂ = 0.03.
    ssim: f64,
}

/// Half-width of the window of the structural similarity, pixels; the next constant is the standard deviation of its weights.
const REACH: usize = 5;
const SPREAD: f64 = 1.5;

impl Likeness {
    pub(crate) fn of(drawn: &Picture, seen: &Picture) -> Likeness {
        let differences = drawn
            .dn
            .iter()
            .zip(&seen.dn)
            .map(|(one, other)| one - other);
        let count = drawn.dn.len() as f64;
        let absolute: f64 = differences.clone().map(f64::abs).sum();
        let squared: f64 = differences.map(|difference| difference * difference).sum();
        let colours = [0, 1, 2].map(|colour| {
            let plane = |picture: &Picture| -> Vec<f64> {
                picture.dn.iter().skip(colour).step_by(3).copied().collect()
            };
            similarity(&plane(drawn), &plane(seen), drawn.width)
        });
        Likeness {
            l1_dn: absolute / count,
            psnr_db: 10.0 * (255.0 * 255.0 * count / squared).log10(),
            ssim: colours.iter().sum::<f64>() / 3.0,
        }
    }
}

/// Mean structural similarity over the windows that lie completely within the picture.
fn similarity(one: &[f64], other: &[f64], width: usize) -> f64 {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<_>>();
    let [mean, other_mean] = [one, other].map(|plane| smoothed(plane, width));
    let square = smoothed(&product(one, one), width);
    let other_square = smoothed(&product(other, other), width);
    let mixed = smoothed(&product(one, other), width);
    let [c1, c2] = [0.01_f64 * 255.0, 0.03 * 255.0].map(|root| root * root);
    let values = (0..mean.len()).map(|at| {
        let (m, n) = (mean[at], other_mean[at]);
        let covariance = mixed[at] - m * n;
        let variances = square[at] - m * m + other_square[at] - n * n;
        (2.0 * m * n + c1) * (2.0 * covariance + c2) / ((m * m + n * n + c1) * (variances + c2))
    });
    values.sum::<f64>() / mean.len() as f64
}

/// Weighted means over each window that fits in the picture.
fn smoothed(plane: &[f64], width: usize) -> Vec<f64> {
    let weights: [f64; 2 * REACH + 1] = std::array::from_fn(|at| {
        let off = (at as f64 - REACH as f64) / SPREAD;
        (-0.5 * off * off).exp()
    });
    let sum: f64 = weights.iter().sum();
    let weights = weights.map(|weight| weight / sum);
    let weigh = |values: &mut dyn Iterator<Item = f64>| -> f64 {
        weights
            .iter()
            .zip(values)
            .map(|(weight, value)| weight * value)
            .sum()
    };
    let across: Vec<f64> = plane
        .chunks(width)
        .flat_map(|row| row.windows(weights.len()))
        .map(|window| weigh(&mut window.iter().copied()))
        .collect();
    let narrower = width + 1 - weights.len();
    let rows = (across.len() / narrower + 1).saturating_sub(weights.len());
    (0..rows * narrower)
        .map(|at| weigh(&mut across[at..].iter().step_by(narrower).copied()))
        .collect()
}

/// Mean of each measure over presses, with its 95 % confidence interval by Student's t.
pub(crate) fn summary(presses: &[Likeness]) -> String {
    let row = |of: fn(&Likeness) -> f64, digits: usize| {
        let count = presses.len() as f64;
        let mean = presses.iter().map(of).sum::<f64>() / count;
        let squares = presses
            .iter()
            .map(|press| (of(press) - mean) * (of(press) - mean));
        let error = (squares.sum::<f64>() / (count - 1.0) / count).sqrt();
        let [low, high] = [-1.0, 1.0].map(|side| mean + side * student(count - 1.0) * error);
        let text = format!("{mean:.digits$} ({low:.digits$} … {high:.digits$})");
        format!("{text:<23}")
    };
    [
        row(|press| press.l1_dn, 2),
        row(|press| press.psnr_db, 1),
        row(|press| press.ssim, 3),
    ]
    .concat()
}

/// 97.5 % quantile of Student's t, by the first terms of the Cornish-Fisher expansion: accurate to 0.001 from ten degrees of freedom on.
fn student(freedom: f64) -> f64 {
    let z = 1.959_963_985_f64;
    let (z3, z5) = (z.powi(3), z.powi(5));
    z + (z3 + z) / (4.0 * freedom) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom)
}
