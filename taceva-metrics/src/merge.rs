//! Joining what was kept apart.

/// A summary whose parts can be joined and taken away again, exactly; what is merged twice counts twice.
pub(crate) trait Merge {
    /// Takes over what `other` holds.
    fn merge(&mut self, other: &Self);
    /// Takes away what `other` holds, which was merged before.
    fn subtract(&mut self, other: &Self);
    /// Takes over what `other` holds, `times` over.
    fn merge_times(&mut self, other: &Self, times: u32) {
        (0..times).for_each(|_| self.merge(other));
    }
}

impl<T: Merge> Merge for Vec<T> {
    fn merge(&mut self, other: &Vec<T>) {
        for (part, other) in self.iter_mut().zip(other) {
            part.merge(other);
        }
    }

    fn subtract(&mut self, other: &Vec<T>) {
        for (part, other) in self.iter_mut().zip(other) {
            part.subtract(other);
        }
    }
}
