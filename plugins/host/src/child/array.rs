//! Arrays of numbers in shared memory, little-endian and without padding between arrays.

use taceva_core::{Features, Targets, TrainingSet};

use super::memory::SharedMemory;
use super::wire::{Failure, SetShape};
use taceva_core::ErrorKind;

/// Number with a fixed memory layout.
pub(crate) trait Number: Copy {
    /// Size of one number, bytes.
    const LENGTH: usize;
    /// Writes the number into [`LENGTH`](Number::LENGTH) bytes.
    fn put(self, into: &mut [u8]);
    /// Reads a number from [`LENGTH`](Number::LENGTH) bytes.
    fn get(from: &[u8]) -> Self;
}

macro_rules! numbers {
    ($($type:ty),*) => {$(
        impl Number for $type {
            const LENGTH: usize = size_of::<$type>();
            fn put(self, into: &mut [u8]) {
                into.copy_from_slice(&self.to_le_bytes());
            }
            fn get(from: &[u8]) -> $type {
                let mut bytes = [0; size_of::<$type>()];
                bytes.copy_from_slice(from);
                <$type>::from_le_bytes(bytes)
            }
        }
    )*};
}
numbers!(f32, f64, u32);

/// Writes `numbers` at the front of `into`, which must be long enough, and returns the rest of the buffer.
pub(crate) fn put<'b, T: Number>(numbers: &[T], into: &'b mut [u8]) -> &'b mut [u8] {
    let (place, rest) = into.split_at_mut(numbers.len() * T::LENGTH);
    for (number, place) in numbers.iter().zip(place.chunks_exact_mut(T::LENGTH)) {
        number.put(place);
    }
    rest
}

/// Reads `count` numbers from the front of `from` and returns them with the rest. `None` if `from` is too short.
pub(crate) fn get<T: Number>(count: usize, from: &[u8]) -> Option<(Vec<T>, &[u8])> {
    let (place, rest) = from.split_at_checked(count.checked_mul(T::LENGTH)?)?;
    Some((place.chunks_exact(T::LENGTH).map(T::get).collect(), rest))
}

/// Allocates shared memory of `bytes` bytes, at least one byte. Fails for `None`, the result of a size computation that overflowed.
pub(crate) fn memory(bytes: Option<usize>) -> Result<SharedMemory, Failure> {
    let refused = |why: &str| Failure::new(ErrorKind::OutOfRange, "share memory", why);
    let bytes = bytes.ok_or_else(|| refused("the size exceeds the address space"))?;
    SharedMemory::new(bytes.max(1)).map_err(|error| refused(&error.to_string()))
}

/// Copies targets, features and groups of `set`, in this order, to shared memory. Also returns the shape of `set`.
pub(crate) fn share(set: &TrainingSet<'_>) -> Result<(SetShape, SharedMemory), Failure> {
    let (values, targets) = (set.features.values(), set.targets.values);
    let groups = set.groups.unwrap_or_default();
    let bytes = (values.len().checked_mul(f32::LENGTH))
        .zip(targets.len().checked_mul(f64::LENGTH))
        .zip(groups.len().checked_mul(u32::LENGTH))
        .and_then(|((values, targets), groups)| values.checked_add(targets)?.checked_add(groups));
    let mut memory = memory(bytes)?;
    let rest = put(targets, memory.bytes_mut());
    let rest = put(values, rest);
    put(groups, rest);
    let shape = SetShape {
        samples: set.features.samples() as u64,
        shape: set.features.shape(),
        channels: set.targets.channels.clone(),
        has_groups: set.groups.is_some(),
    };
    Ok((shape, memory))
}

/// Training set that owns its numbers.
pub(crate) struct OwnedSet {
    shape: SetShape,
    features: Features,
    targets: Vec<f64>,
    groups: Option<Vec<u32>>,
}

impl OwnedSet {
    /// Reads a training set with the dimensions `shape` from `memory`.
    pub(crate) fn take(shape: SetShape, memory: &mut SharedMemory) -> Result<OwnedSet, Failure> {
        let refused = || {
            let why = "the shared memory is smaller than its samples";
            Failure::new(ErrorKind::Protocol, "read samples", why)
        };
        let samples = usize::try_from(shape.samples).map_err(|_| refused())?;
        let sides = shape.shape;
        let length = (sides.height.checked_mul(sides.width))
            .and_then(|area| area.checked_mul(sides.depth))
            .and_then(|length| length.checked_mul(samples))
            .ok_or_else(refused)?;
        let count = samples.checked_mul(shape.channels.len());
        let (targets, rest) = count
            .and_then(|count| get(count, memory.bytes_mut()))
            .ok_or_else(refused)?;
        let (values, rest) = get(length, rest).ok_or_else(refused)?;
        let groups = match shape.has_groups {
            true => Some(get(samples, rest).ok_or_else(refused)?.0),
            false => None,
        };
        let features = Features::new(sides, values).map_err(|_| refused())?;
        Ok(OwnedSet {
            shape,
            features,
            targets,
            groups,
        })
    }

    /// Borrows the set in the form that estimators accept.
    pub(crate) fn set(&self) -> TrainingSet<'_> {
        TrainingSet::new(
            &self.features,
            Targets::new(&self.shape.channels, &self.targets),
        )
        .with_groups(self.groups.as_deref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::{Channel, Channels, FeatureShape};

    #[test]
    fn samples_arrive_as_they_went_and_fewer_than_said_are_refused() {
        let channels = Channels::new([Channel::PZ, Channel::FZ]).expect("each once");
        let values = vec![0.1, f32::MIN_POSITIVE, -0.0, 4.0, 5.0, 6.0];
        let features = Features::new(FeatureShape::flat(2), values).expect("three samples");
        let set = TrainingSet::new(
            &features,
            Targets::new(&channels, &[1.0, 2.0, 3.0, 0.1 + 0.2, 5.0, 6.0]),
        )
        .with_groups(&[7, 7, 9][..]);
        let (shape, mut memory) = share(&set).expect("memory");
        let owned = OwnedSet::take(shape.clone(), &mut memory).expect("whole");
        let there = owned.set();
        assert_eq!(there.features, set.features);
        assert_eq!(there.targets.values, set.targets.values);
        assert_eq!(there.targets.channels, set.targets.channels);
        assert_eq!(there.groups, set.groups);
        for samples in [4, u64::MAX, u64::MAX / 8] {
            let more = SetShape {
                samples,
                ..shape.clone()
            };
            assert!(OwnedSet::take(more, &mut memory).is_err(), "{samples}");
        }
    }
}
