//! Distributions that budgets and curves need: quantiles of the normal, Student and F distributions, and the factor of detection.

/// Most halvings of a bracket, each of which adds a bit.
const HALVINGS: u32 = 200;

/// z with P(Z ≤ z) = `p`, for `p` in 0..1.
///
/// # Reference
/// Wichura, Algorithm AS 241 (PPND16), Applied Statistics 37 (1988).
pub(crate) fn normal_quantile(p: f64) -> f64 {
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(r, &CENTRE);
    }
    let tail = if q < 0.0 { p } else { 1.0 - p };
    let r = (-tail.ln()).sqrt();
    let z = match r <= 5.0 {
        true => ratio(r - 1.6, &MIDDLE),
        false => ratio(r - 5.0, &FAR),
    };
    if q < 0.0 { -z } else { z }
}

/// Coefficients of numerator and denominator, the highest power first.
type Ratio = [[f64; 8]; 2];

fn ratio(r: f64, of: &Ratio) -> f64 {
    let [top, bottom] = of.map(|all| all.iter().fold(0.0, |sum, next| sum * r + next));
    top / bottom
}

#[rustfmt::skip]
const CENTRE: Ratio = [
    [2_509.080_928_730_122_7, 33_430.575_583_588_13, 67_265.770_927_008_7, 45_921.953_931_549_87,
     13_731.693_765_509_46, 1_971.590_950_306_551_4, 133.141_667_891_784_38, 3.387_132_872_796_366_5],
    [5_226.495_278_852_545, 28_729.085_735_721_943, 39_307.895_800_092_71, 21_213.794_301_586_597,
     5_394.196_021_424_751, 687.187_007_492_057_9, 42.313_330_701_600_91, 1.0],
];
#[rustfmt::skip]
const MIDDLE: Ratio = [
    [7.745_450_142_783_414e-4, 0.022_723_844_989_269_184, 0.241_780_725_177_450_6, 1.270_458_252_452_368_4,
     3.647_848_324_763_204_5, 5.769_497_221_460_691, 4.630_337_846_156_546, 1.423_437_110_749_683_5],
    [1.050_750_071_644_416_9e-9, 5.475_938_084_995_345e-4, 0.015_198_666_563_616_457, 0.148_103_976_427_480_08,
     0.689_767_334_985_1, 1.676_384_830_183_803_8, 2.053_191_626_637_759, 1.0],
];
#[rustfmt::skip]
const FAR: Ratio = [
    [2.010_334_399_292_288e-7, 2.711_555_568_743_487_6e-5, 0.001_242_660_947_388_078_4, 0.026_532_189_526_576_124,
     0.296_560_571_828_504_87, 1.784_826_539_917_291_3, 5.463_784_911_164_114, 6.657_904_643_501_103],
    [2.044_263_103_389_939_8e-15, 1.421_511_758_316_446e-7, 1.846_318_317_510_054_8e-5, 7.868_691_311_456_133e-4,
     0.014_875_361_290_850_615, 0.136_929_880_922_735_8, 0.599_832_206_555_888, 1.0],
];

/// ln Γ(z), z > 0, by Lanczos with g = 607/128 and 15 terms.
fn ln_gamma(z: f64) -> f64 {
    #[rustfmt::skip]
    const TERMS: [f64; 14] = [
        57.156_235_665_862_92, -59.597_960_355_475_49, 14.136_097_974_741_746, -0.491_913_816_097_620_2,
        3.399_464_998_481_189e-5, 4.652_362_892_704_858e-5, -9.837_447_530_487_956e-5, 1.580_887_032_249_125e-4,
        -2.102_644_417_241_049e-4, 2.174_396_181_152_126_5e-4, -1.643_181_065_367_639e-4, 8.441_822_398_385_275e-5,
        -2.619_083_840_158_141e-5, 3.689_918_265_953_163e-6,
    ];
    let base = z + 5.242_187_5;
    let mut at = z;
    let mut sum = 0.999_999_999_999_997_1;
    for term in TERMS {
        at += 1.0;
        sum += term / at;
    }
    (z + 0.5) * base.ln() - base + (2.506_628_274_631_000_5 * sum / z).ln()
}

/// xᵃ (1 − x)ᵇ / (a B(a, b)).
fn front(a: f64, b: f64, x: f64, rest: f64) -> f64 {
    let scale = ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b);
    (scale + a * x.ln() + b * rest.ln()).exp() / a
}

/// Regularised incomplete beta function Iₓ(a, b), with `rest` = 1 − x so that no digit of it is lost.
///
/// # Reference
/// Press and others, Numerical Recipes, 6.4: the continued fraction by Lentz.
fn incomplete_beta(a: f64, b: f64, x: f64, rest: f64) -> f64 {
    if x <= 0.0 || rest <= 0.0 {
        return if x <= 0.0 { 0.0 } else { 1.0 };
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - front(b, a, rest, x) * fraction(b, a, rest);
    }
    front(a, b, x, rest) * fraction(a, b, x)
}

fn fraction(a: f64, b: f64, x: f64) -> f64 {
    const LEAST: f64 = 1e-300;
    let kept = |value: f64| if value.abs() < LEAST { LEAST } else { value };
    let mut c = 1.0;
    let mut d = 1.0 / kept(1.0 - (a + b) * x / (a + 1.0));
    let mut result = d;
    for step in 1..20_000 {
        let m = f64::from(step);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let mut change = 1.0;
        for term in [even, odd] {
            d = 1.0 / kept(1.0 + term * d);
            c = kept(1.0 + term / c);
            change = d * c;
            result *= change;
        }
        if (change - 1.0).abs() < 1e-16 {
            break;
        }
    }
    result
}

/// P(|T| ≥ |t|) of Student's distribution.
pub(crate) fn student_beyond(t: f64, freedom: f64) -> f64 {
    let square = t * t;
    let sum = freedom + square;
    incomplete_beta(freedom / 2.0, 0.5, freedom / sum, square / sum)
}

/// The t for which ±t encloses the share `central`; of the normal distribution for an infinite `freedom`.
pub(crate) fn student_quantile(central: f64, freedom: f64) -> f64 {
    if freedom.is_infinite() {
        return normal_quantile(f64::midpoint(1.0, central));
    }
    root(1.0, |t| student_beyond(t, freedom) - (1.0 - central))
}

/// P(F ≥ f) of the F distribution.
pub(crate) fn f_upper(f: f64, [top, bottom]: [f64; 2]) -> f64 {
    let sum = bottom + top * f;
    incomplete_beta(bottom / 2.0, top / 2.0, bottom / sum, top * f / sum)
}

/// The f with P(F ≤ f) = `p`.
pub(crate) fn f_quantile(p: f64, freedoms: [f64; 2]) -> f64 {
    root(1.0, |f| f_upper(f, freedoms) - (1.0 - p))
}

/// The point above 0 at which a falling function is 0. `start` begins the bracket.
fn root(start: f64, falling: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, start);
    while falling(high) > 0.0 && high < 1e300 {
        low = high;
        high *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if middle <= low || middle >= high {
            break;
        }
        match falling(middle) > 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    f64::midpoint(low, high)
}

/// δ with P(t′ ≤ t) = `beta` for the t that Student's distribution exceeds with `alpha`.
///
/// # Reference
/// Currie, Pure and Applied Chemistry 67 (1995), 3.7.2; ISO 11843-2, 5.1.
pub(crate) fn detection_factor(freedom: f64, [alpha, beta]: [f64; 2]) -> f64 {
    let threshold = student_quantile(1.0 - 2.0 * alpha, freedom);
    root(threshold, |shift| {
        noncentral_below(threshold, freedom, shift) - beta
    })
}

/// P(t′ ≤ t) for t ≥ 0 and the noncentrality `shift`.
///
/// # Reference
/// Lenth, Algorithm AS 243, Applied Statistics 38 (1989), with Σ qⱼ = 1 − 2 Φ(−δ).
fn noncentral_below(t: f64, freedom: f64, shift: f64) -> f64 {
    let half = freedom / 2.0;
    let (sum, y) = (freedom + t * t, shift * shift / 2.0);
    let (x, rest) = (t * t / sum, freedom / sum);
    let (mut p, mut q) = (
        (-y).exp(),
        shift * (-y).exp() * std::f64::consts::FRAC_2_PI.sqrt(),
    );
    let mut shares = [0.5, 1.0].map(|a| incomplete_beta(a, half, x, rest));
    let mut lost = [0.5, 1.0].map(|a| front(a, half, x, rest));
    let mut total = 0.0;
    for step in 0..10_000 {
        let at = f64::from(step);
        total += p * shares[0] - q * (1.0 - shares[1]);
        shares[0] -= lost[0];
        shares[1] -= lost[1];
        lost[0] *= x * (at + 0.5 + half) / (at + 1.5);
        lost[1] *= x * (at + 1.0 + half) / (at + 2.0);
        p *= y / (at + 1.0);
        q *= y / (at + 1.5);
        if at > y && p + q < 1e-18 {
            break;
        }
    }
    f64::midpoint(1.0, total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64, tolerance: f64) {
        assert!(
            (found / expected - 1.0).abs() < tolerance,
            "{found} is not {expected}"
        );
    }

    #[test]
    fn quantiles_agree_with_published_ones() {
        near(normal_quantile(0.975), 1.959_963_984_540_054, 1e-15);
        near(normal_quantile(0.999), 3.090_232_306_167_813, 1e-14);
        near(-normal_quantile(1e-12), 7.034_483_825_301_131, 1e-13);
        near(student_quantile(0.99, 16.0), 2.920_781_622_425_1, 1e-13);
        near(student_quantile(0.95, 1.0), 12.706_204_736_174_7, 1e-12);
        near(student_quantile(0.95, 250.75), 1.969_469_740_099, 1e-12);
        near(
            student_quantile(0.95, f64::INFINITY),
            1.959_963_984_540_054,
            1e-15,
        );
        // F of 1 and ν degrees of freedom is the square of Student's t.
        near(
            f_quantile(0.95, [1.0, 16.0]),
            2.119_905_299_221_254_7_f64.powi(2),
            1e-12,
        );
    }

    #[test]
    fn factors_of_detection_agree_with_50_digits() {
        for (freedom, expected) in [
            (8.0, 3.617_126_558_904_401),
            (9.0, 3.575_384_834_044_819),
            (19.0, 3.414_994_210_194_465),
            (29.0, 3.369_887_208_450_547),
        ] {
            near(detection_factor(freedom, [0.05, 0.05]), expected, 1e-11);
        }
    }
}
