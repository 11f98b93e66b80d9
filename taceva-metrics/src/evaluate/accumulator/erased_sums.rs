//! Type-erased sums of a family, so that code for storage, merges and resampling is compiled once.

use std::any::Any;

use crate::exact::merge::Merge;

/// Sums of all parts of one family, as a type-erased `Vec`.
pub(crate) struct ErasedSums(Box<dyn AnySums>);

/// Operations on the sums of all parts, for sums of unknown type.
trait AnySums: Any + Send {
    fn merge(&mut self, other: &dyn Any);
    fn merge_times(&mut self, other: &dyn Any, times: u32);
    fn copy(&self) -> ErasedSums;
}

impl<S: Merge + Clone + Send + 'static> AnySums for Vec<S> {
    fn merge(&mut self, other: &dyn Any) {
        Merge::merge(self, typed::<S>(other));
    }

    fn merge_times(&mut self, other: &dyn Any, times: u32) {
        Merge::merge_times(self, typed::<S>(other), times);
    }

    fn copy(&self) -> ErasedSums {
        ErasedSums::new(self.clone())
    }
}

fn typed<S: 'static>(parts: &dyn Any) -> &Vec<S> {
    parts.downcast_ref().expect(ONE_FAMILY)
}

/// Panic message for sums of another type. The family of an accumulator creates all its sums, so the panic is impossible.
const ONE_FAMILY: &str = "parts of one family";

impl ErasedSums {
    pub(super) fn new<S: Merge + Clone + Send + 'static>(sums: Vec<S>) -> ErasedSums {
        ErasedSums(Box::new(sums))
    }

    /// Sums of each part, in the type `S` of the family. Panics for another type.
    pub(super) fn sums<S: 'static>(&self) -> &Vec<S> {
        typed(&*self.0)
    }

    /// Mutable sums of each part, in the type `S` of the family. Panics for another type.
    pub(super) fn sums_mut<S: 'static>(&mut self) -> &mut Vec<S> {
        let parts: &mut dyn Any = &mut *self.0;
        parts.downcast_mut().expect(ONE_FAMILY)
    }
}

impl Clone for ErasedSums {
    fn clone(&self) -> ErasedSums {
        self.0.copy()
    }
}

impl Merge for ErasedSums {
    fn merge(&mut self, other: &ErasedSums) {
        self.0.merge(&*other.0);
    }

    fn merge_times(&mut self, other: &ErasedSums, times: u32) {
        self.0.merge_times(&*other.0, times);
    }
}
