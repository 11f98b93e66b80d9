//! Buffers for temporary use by the passes.

use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::panel::Aligned;

/// Buffers for one pass of a convolution.
pub(crate) struct Rooms<'a> {
    /// Buffer for transformed weights or their gradient.
    pub(crate) transformed: &'a mut [f32],
    pub(crate) tiles: &'a TileRooms,
}

/// Pool of buffers for transformed tiles and for outputs of separate parts. A thread takes or allocates a buffer, and returns it after use.
#[derive(Debug, Default)]
pub(crate) struct TileRooms {
    spare: Mutex<Vec<Aligned>>,
}

impl TileRooms {
    /// Calls `work` with a buffer of `length` values. The initial values are unspecified.
    pub(super) fn with<R>(&self, length: usize, work: impl FnOnce(&mut [f32]) -> R) -> R {
        let mut room = self.taken(length).unwrap_or_else(|| Aligned::zeros(length));
        let result = work(&mut room[..length]);
        self.spare().push(room);
        result
    }

    /// Takes the most recently returned buffer that is long enough. If no buffer is long enough, frees one and returns `None`.
    fn taken(&self, length: usize) -> Option<Aligned> {
        let mut spare = self.spare();
        let position = spare.iter().rposition(|room| length <= room.len());
        match position {
            Some(position) => Some(spare.remove(position)),
            None => {
                spare.pop();
                None
            }
        }
    }

    fn spare(&self) -> MutexGuard<'_, Vec<Aligned>> {
        self.spare.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_room_is_used_again_and_replaced_when_it_is_too_short() {
        let rooms = TileRooms::default();
        let first = rooms.with(64, |room| room.as_ptr());
        let again = rooms.with(32, |room| (room.as_ptr(), room.len()));
        assert_eq!(again, (first, 32));
        assert_eq!(rooms.with(128, |room| room.len()), 128);
        assert_eq!(rooms.spare().len(), 1);
    }
}
