//! Sending end of a message stream, which applies the faults of the link.

use std::collections::VecDeque;
use std::io;
use std::time::Duration;

use crate::bench::WallBench;
use crate::fault::{Device, FaultKind};

/// Sending end of one device's link.
#[derive(Debug)]
pub(crate) struct Link {
    device: Device,
    /// Start of a message of this protocol that never ends or has an absurd length.
    hostile: &'static [u8],
    held: Vec<u8>,
    held_count: usize,
    /// Delayed messages with their arrival times.
    under_way: VecDeque<(Duration, Vec<u8>)>,
}

/// A message of another protocol.
const FOREIGN: &[u8] = b"HTTP/1.1 400 Bad Request\r\nContent-Length: 0\r\n\r\n";
/// Number of messages that are sent together under the fault [`FaultKind::Merged`].
const MERGED: usize = 4;
/// Number of pieces in which a message is sent under the fault [`FaultKind::Split`], with a pause after each piece.
const PIECES: usize = 5;
const BETWEEN_PIECES: Duration = Duration::from_micros(200);

impl Link {
    /// Link of `device`; `hostile` is the start of a message with an absurd length.
    pub(crate) fn new(device: Device, hostile: &'static [u8]) -> Link {
        Link {
            device,
            hostile,
            held: Vec::new(),
            held_count: 0,
            under_way: VecDeque::new(),
        }
    }

    /// Sends `message` by `write`, changed by the present faults.
    ///
    /// # Errors
    /// Error of `write`.
    pub(crate) fn send(
        &mut self,
        bench: &WallBench,
        message: &[u8],
        mut write: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let is_on = |kind| bench.is_faulty(self.device, kind);
        if bench.withholds(self.device) {
            return Ok(());
        }
        for (kind, before) in [
            (FaultKind::Foreign, FOREIGN),
            (FaultKind::Hostile, self.hostile),
        ] {
            if is_on(kind) {
                self.held.extend_from_slice(before);
            }
        }
        let is_split = is_on(FaultKind::Split);
        let is_merged = is_on(FaultKind::Merged);
        self.held.extend_from_slice(message);
        self.held_count += 1;
        if is_on(FaultKind::Late) || (is_merged && self.held_count < MERGED) {
            return Ok(());
        }
        let bytes = std::mem::take(&mut self.held);
        self.held_count = 0;
        let lag = bench.lag(self.device);
        if !lag.is_zero() || !self.under_way.is_empty() {
            self.under_way.push_back((bench.now() + lag, bytes));
            return self.deliver(bench.now(), write);
        }
        if !is_split {
            return write(&bytes);
        }
        for piece in bytes.chunks(bytes.len().div_ceil(PIECES)) {
            write(piece)?;
            std::thread::sleep(BETWEEN_PIECES);
        }
        Ok(())
    }

    /// Waits until the time `until` since the start of the bench, and delivers delayed messages.
    pub(crate) fn rest_until(
        &mut self,
        bench: &WallBench,
        until: Duration,
        mut write: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        loop {
            let now = bench.now();
            self.deliver(now, &mut write)?;
            if now >= until {
                return Ok(());
            }
            let next = self.under_way.front().map_or(until, |(due, _)| *due);
            std::thread::sleep(next.min(until).saturating_sub(now));
        }
    }

    fn deliver(
        &mut self,
        now: Duration,
        mut write: impl FnMut(&[u8]) -> io::Result<()>,
    ) -> io::Result<()> {
        while let Some((due, _)) = self.under_way.front()
            && *due <= now
            && let Some((_, bytes)) = self.under_way.pop_front()
        {
            write(&bytes)?;
        }
        Ok(())
    }

    /// Drops held messages.
    pub(crate) fn forget(&mut self) {
        self.under_way.clear();
        self.held.clear();
        self.held_count = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::Fault;
    use crate::options::BenchOptions;

    /// Bytes of each write when eight messages of ten bytes are sent under the fault `kind`.
    fn written(kind: Option<FaultKind>) -> Vec<Vec<u8>> {
        let bench = WallBench::start(&BenchOptions::quiet(1)).expect("a bench");
        if let Some(kind) = kind {
            bench.inject(Fault {
                device: Device::Force,
                kind,
                lasts: Duration::from_secs(100),
            });
        }
        let mut link = Link::new(Device::Force, b"\xff\xff");
        let mut writes = Vec::new();
        for number in 0..8_u8 {
            let write = |bytes: &[u8]| {
                writes.push(bytes.to_vec());
                Ok(())
            };
            link.send(&bench, &[number; 10], write).expect("written");
        }
        writes
    }

    #[test]
    fn messages_are_left_out_held_cut_joined_or_preceded_and_never_changed() {
        let whole: Vec<u8> = (0..8).flat_map(|number| [number; 10]).collect();
        let counts = |kind| {
            let writes = written(kind);
            (writes.len(), writes.concat() == whole)
        };
        assert_eq!(counts(None), (8, true));
        assert_eq!(counts(Some(FaultKind::Split)), (40, true));
        assert_eq!(counts(Some(FaultKind::Merged)), (2, true));
        for kind in [FaultKind::Drop, FaultKind::Silent, FaultKind::Late] {
            assert_eq!(counts(Some(kind)).0, 0, "{kind}");
        }
        for (kind, before) in [
            (FaultKind::Hostile, &b"\xff\xff"[..]),
            (FaultKind::Foreign, FOREIGN),
        ] {
            let writes = written(Some(kind));
            assert_eq!(writes.len(), 8, "{kind}");
            for (number, write) in (0..8).zip(&writes) {
                let (found, message) = write.split_at(before.len());
                assert_eq!((found, message), (before, &[number; 10][..]), "{kind}");
            }
        }
    }

    #[test]
    fn what_lags_arrives_whole_in_its_turn_and_by_so_much_later() {
        let bench = WallBench::start(&BenchOptions::quiet(1)).expect("a bench");
        let lag = Duration::from_millis(30);
        bench.set_lag(Device::Force, lag);
        let mut link = Link::new(Device::Force, b"");
        let mut sent = Vec::new();
        let mut arrived: Vec<(Duration, Vec<u8>)> = Vec::new();
        for number in 0..12_u8 {
            let mut write = |bytes: &[u8]| {
                arrived.push((bench.now(), bytes.to_vec()));
                Ok(())
            };
            if number < 6 {
                sent.push(bench.now());
                link.send(&bench, &[number], &mut write).expect("sent");
            }
            let until = bench.now() + Duration::from_millis(10);
            link.rest_until(&bench, until, &mut write).expect("waited");
        }
        assert_eq!(arrived.len(), 6);
        for (number, ((at, bytes), sent)) in (0..6).zip(arrived.iter().zip(&sent)) {
            assert_eq!(bytes, &[number]);
            // A busy machine may be late, but nothing is early.
            let late = *at - *sent;
            assert!((lag..lag * 3).contains(&late), "{late:?}");
        }
    }

    #[test]
    fn what_a_late_link_held_comes_at_once() {
        let bench = WallBench::start(&BenchOptions::quiet(1)).expect("a bench");
        bench.inject(Fault {
            device: Device::Force,
            kind: FaultKind::Late,
            lasts: Duration::from_millis(20),
        });
        let mut link = Link::new(Device::Force, b"");
        let mut writes: Vec<Vec<u8>> = Vec::new();
        for number in 0..3_u8 {
            let mut write = |bytes: &[u8]| {
                writes.push(bytes.to_vec());
                Ok(())
            };
            link.send(&bench, &[number], &mut write).expect("held");
            std::thread::sleep(Duration::from_millis(12));
        }
        assert_eq!(writes, [[0, 1, 2]]);
    }
}
