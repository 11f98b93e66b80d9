//! Sums that common algorithms compute wrongly: whole numbers, numbers over the whole range, and sums with many carries.

use taceva_metrics::ExactSum;

fn sum(values: impl IntoIterator<Item = f64>) -> ExactSum {
    values.into_iter().collect()
}

/// 2^exponent to the bit. The result of `powi` for subnormal numbers depends on the compiler and the machine.
fn power(exponent: i32) -> f64 {
    let bits = match exponent {
        -1022..=1023 => u64::from((exponent + 1023).unsigned_abs()) << 52,
        -1074..=-1023 => 1 << (exponent + 1074),
        _ => panic!("2^{exponent} is not a binary64"),
    };
    f64::from_bits(bits)
}

#[test]
fn more_deposits_than_a_digit_can_hold_without_carrying() {
    const TIMES: u64 = 1_000_003;
    // Mantissa with all bits set, at each position within a digit.
    const MANTISSA: u64 = (1 << 53) - 1;
    for exponent in -40..-5 {
        let value = MANTISSA as f64 * power(exponent);
        let mut repeated = ExactSum::default();
        let mut expected = ExactSum::default();
        for bit in 0..20 {
            // Binary multiplication: doubling is exact.
            if TIMES >> bit & 1 == 1 {
                expected.add(-value * power(bit));
            }
        }
        (0..TIMES % 4096).for_each(|_| repeated.add(-value));
        let mut thousands = ExactSum::default();
        (0..4096).for_each(|_| thousands.add(-value));
        (0..TIMES / 4096).for_each(|_| repeated.merge(&thousands));
        assert_eq!(repeated, expected, "2^{exponent}");
    }
}

#[test]
fn the_least_and_the_greatest_stand_side_by_side() {
    let least = f64::from_bits(1);
    let mut both = ExactSum::default();
    both.add_product(f64::MAX, f64::MAX);
    both.add_product(least, -least);
    both.add(1.0);
    assert_eq!(both.to_f64().to_bits(), f64::INFINITY.to_bits());
    both.add_product(-f64::MAX, f64::MAX);
    assert_eq!(both.to_f64().to_bits(), 1.0_f64.to_bits());
    both.add(-1.0);
    // The remainder is −2⁻²¹⁴⁸: below the range, with its sign.
    assert_eq!(both.to_f64().to_bits(), (-0.0_f64).to_bits());
    assert!(both.to_canonical().is_negative());
    both.add_product(least, least);
    assert_eq!(both, ExactSum::default());
}

#[test]
fn a_product_of_powers_of_two_is_one_at_every_place_within_a_digit() {
    for left in (-900..900).step_by(7) {
        for right in -40..40 {
            let mut product = ExactSum::default();
            product.add_product(power(left), -power(right));
            assert_eq!(product, sum([-power(left + right)]), "2^{left} × 2^{right}");
        }
    }
}

#[test]
fn a_sum_that_wandered_through_the_range_equals_one_that_did_not() {
    let wander = (-1074..1000).step_by(7).map(power);
    let mut wandered = sum(wander.clone().chain([0.1]));
    wander.rev().for_each(|value| wandered.add(-value));
    assert_eq!(wandered, sum([0.1]));
    assert_eq!(wandered.to_f64().to_bits(), 0.1_f64.to_bits());
}

#[test]
fn a_form_gives_its_sum_back() {
    for values in [&[][..], &[-0.0], &[1e300, -1e-300], &[-3.5, 1e-9, 7e20]] {
        let exact = sum(values.iter().copied());
        assert_eq!(ExactSum::from_canonical(&exact.to_canonical()), exact);
    }
}

#[test]
fn negative_zeros_add_up_to_zero() {
    assert_eq!(sum([-0.0, -0.0]).to_f64().to_bits(), 0.0_f64.to_bits());
}

#[test]
#[should_panic(expected = "only finite numbers have a sum")]
fn a_nan_has_no_sum() {
    ExactSum::default().add(f64::NAN);
}

#[test]
fn a_product_and_a_sum_of_it_are_the_same_number() {
    for (left, right) in [(3.0, 5.0), (-0.5, 0.25), (1e150, -1e-150), (0.1, 1.0)] {
        let mut products = ExactSum::default();
        products.add_product(left, right);
        products.add_product(left, -right);
        assert_eq!(products, ExactSum::default());
        products.add_product(left, right);
        assert_eq!(
            products.to_f64().to_bits(),
            (left * right).to_bits(),
            "{left:e} × {right:e}"
        );
    }
}
