//! Press log on the simulated disk. A record counts once it is complete and synced. An incomplete record at the end of the log is removed.

use std::collections::BTreeSet;

use taceva_core::{Frame, PressOutcome, SinkError};

use super::disk::Disk;
use taceva_core::random::fnv_1a;
use taceva_protocol::ContentId;
use taceva_protocol::{PressLog, PressRecord};

/// A recorded press.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) press: ContentId,
    pub(super) outcome: PressOutcome,
    pub(super) samples: Vec<EntrySample>,
}

/// Sample fields that the oracle compares with the truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EntrySample {
    pub(super) number: u32,
    pub(super) stamp_s: f64,
    pub(super) depth_mm: f64,
    pub(super) force_n: f64,
    /// Time, s, tip height, mm, and normal force, N, encoded in the frame; `None` without a frame.
    pub(super) frame: Option<[f64; 3]>,
    /// True if a limit kept the tip from the waypoint.
    pub(super) is_limited: bool,
}

/// Press log on a simulated disk.
pub(super) struct Journal<'a> {
    disk: &'a mut Disk,
    finished: BTreeSet<ContentId>,
    /// Presses that this and earlier processes acknowledged. They are compared with the records on the disk.
    acknowledged: &'a mut Vec<ContentId>,
}

impl<'a> Journal<'a> {
    /// Opens the log, and removes an incomplete record at its end.
    pub(super) fn open(disk: &'a mut Disk, acknowledged: &'a mut Vec<ContentId>) -> Journal<'a> {
        let (entries, whole) = entries(&disk.read());
        disk.cut(whole);
        Journal {
            disk,
            finished: entries.iter().map(|entry| entry.press).collect(),
            acknowledged,
        }
    }
}

impl PressLog for Journal<'_> {
    fn is_finished(&self, press: ContentId) -> bool {
        self.finished.contains(&press)
    }

    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        let payload = encode(record)?;
        let length = u32::try_from(payload.len())?.to_le_bytes();
        let check = fnv_1a(&payload).to_le_bytes();
        self.disk
            .write(&[&length, check.as_slice(), &payload].concat())?;
        self.disk.sync();
        self.finished.insert(record.press);
        self.acknowledged.push(record.press);
        Ok(())
    }

    /// Ignores frames of the untouched gel, because the oracle checks only presses.
    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }
}

/// Complete records of a file, and their total length in bytes.
pub(super) fn entries(bytes: &[u8]) -> (Vec<Entry>, usize) {
    let mut entries = Vec::new();
    let mut whole = 0;
    while let Some((entry, length)) = bytes.get(whole..).and_then(first_entry) {
        entries.push(entry);
        whole += length;
    }
    (entries, whole)
}

const HEAD: usize = 12;
const SAMPLE: usize = 53;

fn first_entry(bytes: &[u8]) -> Option<(Entry, usize)> {
    let length = u32::from_le_bytes(bytes.get(..4)?.try_into().ok()?);
    let check = u64::from_le_bytes(bytes.get(4..HEAD)?.try_into().ok()?);
    let end = HEAD + usize::try_from(length).ok()?;
    let payload = bytes.get(HEAD..end)?;
    (fnv_1a(payload) == check).then_some(())?;
    Some((decode(payload)?, end))
}

fn encode(record: &PressRecord) -> Result<Vec<u8>, SinkError> {
    let mut payload = record.press.to_string().into_bytes();
    let place = PressOutcome::ALL
        .into_iter()
        .position(|outcome| outcome == record.outcome);
    payload.push(u8::try_from(place.ok_or("an outcome without a place")?)?);
    for sample in &record.samples {
        let (_, number) = sample
            .id
            .split_once('/')
            .ok_or("a sample without a number")?;
        let number = number.parse::<u32>()?;
        payload.extend(number.to_le_bytes());
        let truth = |place| sample.truth.get(place).unwrap_or(f64::NAN);
        let stamp_s = sample.stamp.map_or(f64::NAN, |stamp| stamp.valid_s);
        for value in [stamp_s, truth(2), truth(5)] {
            payload.extend(value.to_le_bytes());
        }
        match &sample.frame {
            Some(frame) => payload.extend(frame.bytes()),
            None => payload.extend([0xff; 24]),
        }
        payload.push(u8::from(sample.limited_by.is_some()));
    }
    Ok(payload)
}

fn decode(payload: &[u8]) -> Option<Entry> {
    let press = ContentId::from_hex(std::str::from_utf8(payload.get(..32)?).ok()?)?;
    let outcome = *PressOutcome::ALL.get(usize::from(*payload.get(32)?))?;
    let samples = payload.get(33..)?.chunks_exact(SAMPLE).map(|sample| {
        let value = |at: usize| Some(f64::from_le_bytes(sample.get(at..at + 8)?.try_into().ok()?));
        let frame = [value(28)?, value(36)?, value(44)?];
        Some(EntrySample {
            number: u32::from_le_bytes(sample.get(..4)?.try_into().ok()?),
            stamp_s: value(4)?,
            depth_mm: value(12)?,
            force_n: value(20)?,
            frame: frame[0].is_finite().then_some(frame),
            is_limited: *sample.get(52)? == 1,
        })
    });
    Some(Entry {
        press,
        outcome,
        samples: samples.collect::<Option<_>>()?,
    })
}
