//! Combines independent parts of a standard error.

/// One independent part of a standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    pub(super) standard_error: f64,
    pub(super) freedom: f64,
}

impl Part {
    /// Combines two independent parts with standard errors s₁ and s₂ and degrees of freedom ν₁ and ν₂. The result s² = s₁² + s₂² has s⁴ / (s₁⁴/ν₁ +
    /// s₂⁴/ν₂) degrees of freedom. A part of 0 leaves the other part unchanged.
    ///
    /// # Reference
    /// Welch, The generalization of Student's problem, Biometrika 34 (1947); JCGM 100:2008 (GUM), G.4.1.
    pub(super) fn with(self, other: Part) -> Part {
        let larger = self.standard_error.max(other.standard_error);
        if other.standard_error <= 0.0 {
            return self;
        }
        if self.standard_error <= 0.0 {
            return other;
        }
        let share = |part: Part| {
            let ratio = part.standard_error / larger;
            ratio * ratio
        };
        let (own, others) = (share(self), share(other));
        let all = own + others;
        Part {
            standard_error: root_of_squares(self.standard_error, other.standard_error),
            freedom: all * all / (own * own / self.freedom + others * others / other.freedom),
        }
    }
}

/// √(x² + y²), scaled so that the squares stay within the range of binary64.
pub(super) fn root_of_squares(x: f64, y: f64) -> f64 {
    let larger = x.max(y);
    if larger > 0.0 && larger.is_finite() {
        let (x, y) = (x / larger, y / larger);
        larger * (x * x + y * y).sqrt()
    } else {
        larger
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_add_as_squares_and_share_their_degrees_of_freedom() {
        // 3² + 4² = 5²; 625 / (81 / 9 + 256 / 2) = 625 / 137.
        let [own, other] = [(3.0, 9.0), (4.0, 2.0)].map(|(standard_error, freedom)| Part {
            standard_error,
            freedom,
        });
        for all in [own.with(other), other.with(own)] {
            assert!((all.standard_error - 5.0).abs() < 1e-14);
            assert!((all.freedom - 625.0 / 137.0).abs() < 1e-13);
        }
        // Neither below the smaller nor above the sum of both.
        let equal = own.with(own);
        assert!((equal.freedom - 18.0).abs() < 1e-13);
    }

    #[test]
    fn trainings_that_agree_change_no_bit() {
        let own = Part {
            standard_error: 0.1,
            freedom: 7.3,
        };
        let none = Part {
            standard_error: 0.0,
            freedom: 2.0,
        };
        for all in [own.with(none), none.with(own)] {
            assert_eq!(all.standard_error.to_bits(), 0.1_f64.to_bits());
            assert_eq!(all.freedom.to_bits(), 7.3_f64.to_bits());
        }
    }

    #[test]
    fn the_smallest_parts_are_squared_without_loss() {
        let part = |standard_error| Part {
            standard_error,
            freedom: 4.0,
        };
        let all = part(3e-200).with(part(4e-200));
        assert!((all.standard_error / 5e-200 - 1.0).abs() < 1e-14);
        // (9 + 16)² / (81 / 4 + 256 / 4).
        assert!((all.freedom - 2500.0 / 337.0).abs() < 1e-12);
    }
}
