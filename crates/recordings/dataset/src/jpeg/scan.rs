//! Blocks of a scan, parsed like a decoder but without computing pixels.

use super::bits::Bits;
use super::frame::{Component, Frame};
use super::huffman::Huffman;

/// The tables and settings from the segments before a scan.
#[derive(Debug, Default)]
pub(super) struct Tables {
    /// Tables of DC coefficients, then of AC coefficients.
    pub(super) huffman: [[Option<Huffman>; 4]; 2],
    /// For each quantisation table, the divisor of the DC coefficient.
    pub(super) quantisers: [Option<usize>; 4],
    /// Number of minimum coded units between restart markers; 0 without restart markers.
    pub(super) restart_interval: usize,
}

/// Header of a scan.
#[derive(Debug)]
pub(super) struct Scan {
    /// For each component of the scan, its index in the frame, and the numbers of its DC and AC tables.
    components: Vec<(usize, [usize; 2])>,
    /// First and last coefficient of the band.
    band: [usize; 2],
    /// Number of low bits that the previous scan of the band did not code; 0 in the first scan.
    before: u8,
    /// Number of low bits that later scans code.
    later: u8,
}

/// Limit of a coefficient: twice the greatest coefficient of 8-bit pixels, because some encoders overshoot on purpose.
const GREATEST: i64 = 2_048;

impl Scan {
    pub(super) fn parse(body: &[u8], frame: &mut Frame) -> Result<Scan, String> {
        let cut = || "a scan header is truncated".to_owned();
        let [count, rest @ ..] = body else {
            return Err(cut());
        };
        let coded = rest.get(..2 * usize::from(*count)).ok_or_else(cut)?;
        let [first, last, bits] = rest[coded.len()..] else {
            return Err(cut());
        };
        let (pairs, _) = coded.as_chunks::<2>();
        let mut components = Vec::new();
        for [id, tables] in pairs {
            let place = frame
                .components
                .iter()
                .position(|component| component.id == *id);
            let place = place.ok_or("a scan has a component that the frame lacks")?;
            let tables = [usize::from(tables >> 4), usize::from(tables & 15)];
            if tables.iter().any(|table| *table > 3)
                || components.iter().any(|(of, _)| *of == place)
            {
                return Err("a scan header that contradicts itself".to_owned());
            }
            components.push((place, tables));
        }
        let scan = Scan {
            components,
            band: [usize::from(first), usize::from(last)],
            before: bits >> 4,
            later: bits & 15,
        };
        scan.note_bits(frame)?;
        Ok(scan)
    }

    /// Records the bits that the scan codes. Rejects bits that do not continue the earlier scans.
    fn note_bits(&self, frame: &mut Frame) -> Result<(), String> {
        let wrong = || Err("a scan has its bits out of order".to_owned());
        let [first, last] = self.band;
        let is_interleaved = self.components.len() > 1;
        let fits = match frame.is_progressive {
            false => self.band == [0, 63] && self.before == 0 && self.later == 0,
            true => {
                first <= last
                    && last < 64
                    && (first > 0 || last == 0)
                    && !(first > 0 && is_interleaved)
                    && self.later < 14
                    && (self.before == 0 || self.before == self.later + 1)
            }
        };
        if !fits || self.components.is_empty() || self.components.len() > 4 {
            return wrong();
        }
        for (place, _) in &self.components {
            for missing in &mut frame.components[*place].missing[first..=last] {
                let expected = (self.before > 0).then_some(self.before);
                if *missing != expected {
                    return wrong();
                }
                *missing = Some(self.later);
            }
        }
        Ok(())
    }

    /// Parses every block of the data that begins at `start`. Returns the position of the marker after the data.
    pub(super) fn read(
        &self,
        frame: &mut Frame,
        tables: &Tables,
        bytes: &[u8],
        start: usize,
    ) -> Result<usize, String> {
        let coders = self.coders(frame, tables)?;
        let is_progressive = frame.is_progressive;
        let alone = coders.len() == 1;
        let [wide, high] = match alone {
            true => frame.components[coders[0].place].blocks,
            false => frame.units,
        };
        let mut bits = Bits::new(bytes, start);
        let mut state = State::default();
        let mut restarts = 0_u8;
        let interval = tables.restart_interval;
        for unit in 0..wide * high {
            if interval > 0 && unit > 0 && unit % interval == 0 {
                let end = state.finish(bits)?;
                bits = Bits::new(bytes, restarted(bytes, end, restarts)?);
                restarts = (restarts + 1) % 8;
                state = State::default();
            }
            let (x, y) = (unit % wide, unit / wide);
            for coder in &coders {
                let component = &mut frame.components[coder.place];
                let [across, down] = if alone { [1, 1] } else { component.sampling };
                for block in 0..across * down {
                    let (x, y) = (x * across + block % across, y * down + block / across);
                    let place = y * component.padded[0] + x;
                    match is_progressive {
                        true => self.progressive(coder, component, place, &mut bits, &mut state)?,
                        false => sequential(coder, &mut bits, &mut state)?,
                    }
                }
            }
        }
        let end = state.finish(bits)?;
        // Some encoders end the last interval with a restart marker, too.
        let is_closed = interval > 0 && (wide * high).is_multiple_of(interval);
        let closed = is_closed.then(|| restarted(bytes, end, restarts).ok());
        Ok(closed.flatten().unwrap_or(end))
    }

    fn coders<'a>(&self, frame: &Frame, tables: &'a Tables) -> Result<Vec<Coder<'a>>, String> {
        let needs = [self.band[0] == 0 && self.before == 0, self.band[1] > 0];
        let coders = self.components.iter().map(|(place, numbers)| {
            let table = |kind: usize| match (needs[kind], &tables.huffman[kind][numbers[kind]]) {
                (false, _) => Ok(None),
                (true, Some(table)) => Ok(Some(table)),
                (true, None) => Err("a scan before its Huffman tables"),
            };
            let quantiser = usize::from(frame.components[*place].quantiser);
            let quantiser = tables.quantisers.get(quantiser).copied().flatten();
            Ok(Coder {
                place: *place,
                first: table(0)?,
                others: table(1)?,
                quantiser: quantiser.ok_or("a scan before its quantisation table")? as i64,
            })
        });
        coders.collect()
    }

    /// Parses a block of a progressive scan.
    fn progressive(
        &self,
        coder: &Coder<'_>,
        component: &mut Component,
        place: usize,
        bits: &mut Bits<'_>,
        state: &mut State,
    ) -> Result<(), String> {
        let nonzero = &mut component.nonzero[place];
        match (coder.first, coder.others, self.before) {
            (Some(first), _, _) => state.first(bits, first, coder, self.later),
            (None, None, _) => bits.take(1).map(drop),
            (None, Some(others), 0) => self.first_of_band(bits, others, nonzero, state),
            (None, Some(others), _) => self.refined(bits, others, nonzero, state),
        }
    }

    /// Parses a block of the first scan of a band.
    fn first_of_band(
        &self,
        bits: &mut Bits<'_>,
        table: &Huffman,
        nonzero: &mut u64,
        state: &mut State,
    ) -> Result<(), String> {
        if state.empty_blocks > 0 {
            state.empty_blocks -= 1;
            return Ok(());
        }
        let [mut at, last] = self.band;
        while at <= last {
            let (run, size) = halves(table.decode(bits)?);
            if size == 0 && run < 15 {
                state.empty_blocks = run_of_blocks(bits, run)? - 1;
                return Ok(());
            }
            at += usize::from(run);
            if at > last {
                return Err(OVERFLOW.to_owned());
            }
            if size > 0 {
                bits.take(u32::from(size))?;
                *nonzero |= 1 << at;
            }
            at += 1;
        }
        Ok(())
    }

    /// Parses a block of a scan that adds one bit to each coefficient of a band.
    fn refined(
        &self,
        bits: &mut Bits<'_>,
        table: &Huffman,
        nonzero: &mut u64,
        state: &mut State,
    ) -> Result<(), String> {
        let [mut at, last] = self.band;
        if state.empty_blocks == 0 {
            while at <= last {
                let (run, size) = halves(table.decode(bits)?);
                match (run, size) {
                    (0..15, 0) => {
                        state.empty_blocks = run_of_blocks(bits, run)?;
                        break;
                    }
                    // The sign of a coefficient that becomes nonzero here.
                    (_, 1) => drop(bits.take(1)?),
                    (15, 0) => {}
                    _ => {
                        return Err(
                            "a coefficient of more than one bit in a one-bit scan".to_owned()
                        );
                    }
                }
                // While the run of zeros is skipped, each nonzero coefficient gets one more bit.
                let mut zeros = run;
                while at <= last {
                    if *nonzero >> at & 1 == 1 {
                        bits.take(1)?;
                    } else if zeros == 0 {
                        break;
                    } else {
                        zeros -= 1;
                    }
                    at += 1;
                }
                if at > last {
                    return Err(OVERFLOW.to_owned());
                }
                if size == 1 {
                    *nonzero |= 1 << at;
                }
                at += 1;
            }
        }
        if state.empty_blocks > 0 {
            let band = *nonzero >> at.min(63) & mask(last + 1 - at.min(last + 1));
            for _ in 0..band.count_ones() {
                bits.take(1)?;
            }
            state.empty_blocks -= 1;
        }
        Ok(())
    }
}

const OVERFLOW: &str = "the entropy-coded data has a run beyond the end of a block";

/// Tables and settings for the blocks of a component.
struct Coder<'a> {
    place: usize,
    first: Option<&'a Huffman>,
    others: Option<&'a Huffman>,
    quantiser: i64,
}

/// State passed from block to block between restart markers.
#[derive(Default)]
struct State {
    /// Last DC coefficient of each component of the frame.
    previous: [i64; 4],
    /// Number of following blocks that the last code declared empty.
    empty_blocks: u32,
}

impl State {
    /// Parses the DC coefficient of a block, and rejects a value out of range.
    #[inline]
    fn first(
        &mut self,
        bits: &mut Bits<'_>,
        table: &Huffman,
        coder: &Coder<'_>,
        later: u8,
    ) -> Result<(), String> {
        let size = u32::from(table.decode(bits)?);
        if size > 11 {
            return Err("a DC coefficient has too many bits".to_owned());
        }
        let value = i64::from(bits.take(size)?);
        // The upper half of the numbers of a size is positive, the lower half negative.
        let is_negative = size > 0 && value >> (size - 1) == 0;
        let difference = value - if is_negative { (1 << size) - 1 } else { 0 };
        let previous = &mut self.previous[coder.place.min(3)];
        *previous += difference;
        if (*previous << later).abs() > GREATEST / coder.quantiser.max(1) + 2 {
            return Err("a block is beyond the range of pixel values".to_owned());
        }
        Ok(())
    }

    /// Position of the marker that must follow the last block.
    fn finish(&self, bits: Bits<'_>) -> Result<usize, String> {
        if self.empty_blocks > 0 {
            return Err("a run of empty blocks beyond the last one".to_owned());
        }
        bits.end()
    }
}

/// Parses a block of a sequential scan.
#[inline]
fn sequential(coder: &Coder<'_>, bits: &mut Bits<'_>, state: &mut State) -> Result<(), String> {
    let (Some(first), Some(others)) = (coder.first, coder.others) else {
        return Ok(());
    };
    state.first(bits, first, coder, 0)?;
    let mut at = 1;
    while at < 64 {
        let (run, size) = halves(others.decode(bits)?);
        if size == 0 && run < 15 {
            return Ok(());
        }
        at += usize::from(run) + 1;
        if at > 64 {
            return Err(OVERFLOW.to_owned());
        }
        bits.take(u32::from(size))?;
    }
    Ok(())
}

/// The number of blocks, including this one, without further coefficients.
fn run_of_blocks(bits: &mut Bits<'_>, size: u8) -> Result<u32, String> {
    Ok((1 << size) + bits.take(u32::from(size))?)
}

fn halves(symbol: u8) -> (u8, u8) {
    (symbol >> 4, symbol & 15)
}

/// Mask with the lowest `count` bits set.
fn mask(count: usize) -> u64 {
    if count < 64 {
        (1 << count) - 1
    } else {
        u64::MAX
    }
}

/// Position after restart marker `number`. The marker must be at `position`.
fn restarted(bytes: &[u8], position: usize, number: u8) -> Result<usize, String> {
    let rest = bytes.get(position..).unwrap_or_default();
    let fills = rest.iter().take_while(|byte| **byte == 0xFF).count();
    match rest.get(fills) {
        Some(kind) if fills > 0 && *kind == 0xD0 + number => Ok(position + fills + 1),
        _ => Err(format!(
            "restart marker {number} is missing or out of order at byte {position}"
        )),
    }
}
