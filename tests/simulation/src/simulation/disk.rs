//! Disk that keeps synced data and an arbitrary part of the rest.

use super::draws::Draws;
use super::fault::FaultKind;
use super::world::Sabotage;
use super::world_handle::Shared;

/// File to which programs only append.
pub(super) struct Disk {
    shared: Shared,
    draws: Draws,
    durable: Vec<u8>,
    pending: Vec<u8>,
    crashes: u64,
}

/// Error of a write to a full disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no space left on the simulated disk")]
pub(super) struct Full;

/// Time of a sync, s.
const SYNC_S: f64 = 0.000_2;

impl Disk {
    pub(super) fn new(shared: Shared, draws: Draws) -> Disk {
        Disk {
            shared,
            draws,
            durable: Vec::new(),
            pending: Vec::new(),
            crashes: 0,
        }
    }

    /// Content for a process that opens the file: all written bytes, durable or not.
    pub(super) fn read(&self) -> Vec<u8> {
        [self.durable.as_slice(), self.pending.as_slice()].concat()
    }

    /// Appends bytes; on a full disk, only some of them.
    pub(super) fn write(&mut self, bytes: &[u8]) -> Result<(), Full> {
        let mut world = self.shared.world();
        let now_s = world.now_s;
        // A full disk strikes at the next write, even if the fault has ended.
        let is_full = world.faults.strike_once(FaultKind::FullDisk, now_s);
        drop(world);
        let taken = if is_full {
            bytes.len() / 2
        } else {
            bytes.len()
        };
        self.pending.extend_from_slice(&bytes[..taken]);
        if is_full { Err(Full) } else { Ok(()) }
    }

    /// Makes all written bytes durable.
    pub(super) fn sync(&mut self) {
        self.shared.survive();
        let mut world = self.shared.world();
        world.pass(SYNC_S);
        if world.sabotage != Sabotage::LazyDisk {
            self.durable.append(&mut self.pending);
        }
        drop(world);
        self.shared.survive();
    }

    /// Truncates the file to `length` bytes.
    pub(super) fn cut(&mut self, length: usize) {
        self.durable.append(&mut self.pending);
        self.durable.truncate(length);
    }

    /// Simulates a power cut. All synced bytes remain, and a random number of the bytes that follow. The last byte may be changed.
    pub(super) fn crash(&mut self) {
        self.crashes += 1;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a length is a length"
        )]
        let kept =
            (self.draws.fraction([self.crashes, 0]) * (self.pending.len() as f64 + 1.0)) as usize;
        self.pending.truncate(kept);
        if let Some(last) = self.pending.last_mut()
            && self.draws.bits([self.crashes, 1]).is_multiple_of(2)
        {
            *last ^= 0x40;
        }
        self.durable.append(&mut self.pending);
    }
}
