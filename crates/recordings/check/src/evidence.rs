//! Evidence for checks: the table, the header, the split, and statistics of every frame.

use taceva_core::{Frame, PixelFormat};
use taceva_dataset::{Header, Table};
use taceva_evaluate::Divided;

use crate::depth_facts::DepthFacts;
use crate::signal_facts::SignalFacts;
use crate::tiles::Tiles;
use taceva_dataset::RecordedSessions;

/// Depth from which a sample is in contact, mm. Negative depths are above the gel.
const CONTACT_MM: f64 = 0.01;

/// Data of a recording that checks read.
#[derive(Debug)]
pub struct Evidence<'a> {
    /// Header of the recording.
    pub header: &'a Header,
    /// Labels of the recording.
    pub table: &'a Table,
    /// Cluster of each row for each task of the table.
    pub clusters: &'a [Vec<Option<String>>],
    /// Division of the recording into parts; `None` without a split.
    pub divided: Option<&'a Divided>,
    /// True if the request names the split of `divided`; false for the default split.
    pub is_split_named: bool,
    /// Division whose test part an evaluation scores. By default it has all folds; with a named split it equals the field `divided`.
    pub scored: Option<&'a Divided>,
    /// Division that scores each task of the table: its own folds, or `divided` if the request names a split. `None` for a task without classes or folds.
    pub of_tasks: &'a [Option<Divided>],
    /// Statistics of the frame of each row; empty if no check reads frames.
    pub frames: &'a [Option<FrameFacts>],
    /// Statistics of the frame without contact.
    pub reference: Option<&'a FrameFacts>,
    /// Statistics of every taxel; `None` without taxels, or if no check reads signals.
    pub signals: Option<&'a SignalFacts>,
    /// Statistics of the depth maps of each task; empty if no check reads them.
    pub maps: &'a [DepthFacts],
    /// Rows whose pictures can be decoded although they are damaged, with a description of the damage.
    pub damaged: &'a [(usize, String)],
    /// Sessions on a real rig that made the recording; `None` without a table of sessions.
    pub sessions: Option<&'a RecordedSessions>,
}

impl Evidence<'_> {
    /// True if this program recorded the samples, so that there is no import map.
    pub(crate) fn is_recording(&self) -> bool {
        self.header.sources.is_none() && self.header.mapping().is_empty()
    }

    /// Index of the load channel: the normal force, otherwise the depth. `None` if both are missing.
    pub(crate) fn load(&self) -> Option<usize> {
        let channels = self.table.channels();
        ["Fz", "Pz"]
            .into_iter()
            .find_map(|name| channels.position(name))
    }

    /// For each row, false if its depth label shows contact. If every row has a depth and seems to be in contact, the depths may be positions, and
    /// all rows are true.
    pub(crate) fn without_depth(&self) -> Vec<bool> {
        let rows = self.table.rows();
        let Some(depth) = self.table.channels().position("Pz") else {
            return vec![true; rows];
        };
        let depths = self.table.truth(depth);
        let is_shallow = |row: usize| depths.get(row).is_none_or(|depth| depth < CONTACT_MM);
        let shallow: Vec<bool> = (0..rows).map(is_shallow).collect();
        match shallow.contains(&true) {
            true => shallow,
            false => vec![true; rows],
        }
    }

    /// Rows with a label of the channel at index `position`, each with its value.
    pub(crate) fn labelled(&self, position: usize) -> Vec<(usize, f64)> {
        let column = self.table.truth(position);
        let rows = (0..column.len()).filter_map(|row| Some((row, column.get(row)?)));
        rows.collect()
    }

    /// Row, tiles and load of each picture. The load is the absolute value of the channel at index `load`, in its unit.
    pub(crate) fn loaded_pictures(&self, load: usize) -> Vec<(usize, &Tiles, f64)> {
        let column = self.table.truth(load);
        let frames = self.frames.iter().enumerate();
        let pictures = frames.filter_map(|(row, facts)| {
            let facts = facts.as_ref()?;
            Some((row, &facts.tiles, column.get(row)?.abs()))
        });
        pictures.collect()
    }
}

/// Statistics of one frame.
///
/// # Units
/// Values are fractions of the full scale of the pixel format, 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameFacts {
    /// Means of red, green and blue over all pixels; for gray, three equal values.
    pub mean: [f64; 3],
    /// Fraction of the pixel values that are at full scale.
    pub full: f64,
    /// Fraction of the pixel values that are zero.
    pub zero: f64,
    /// True if all pixels are equal.
    pub is_flat: bool,
    /// Mean absolute difference from the frame without contact, over all pixels and colours; `None` without a frame of the same size.
    pub distance: Option<f64>,
    /// Mean brightness of square tiles, each an eighth of the width wide.
    pub tiles: Tiles,
}

impl FrameFacts {
    /// Statistics of `frame`, compared with `reference`, the frame without contact.
    pub fn of(frame: &Frame, reference: Option<&Frame>) -> FrameFacts {
        FrameFacts {
            tiles: Tiles::of(frame),
            ..FrameFacts::without_tiles(frame, reference)
        }
    }

    /// Statistics of `frame` like [`of`](FrameFacts::of), but without tiles, whose computation takes most of the time.
    pub fn without_tiles(frame: &Frame, reference: Option<&Frame>) -> FrameFacts {
        let format = frame.info().format;
        match format.bytes_per_sample() {
            1 => facts_of_bytes(frame, reference),
            _ => facts_of_samples(frame, reference, format),
        }
    }
}

/// Statistics of 8-bit frames from a histogram, in one pass without arithmetic for each pixel.
fn facts_of_bytes(frame: &Frame, reference: Option<&Frame>) -> FrameFacts {
    let depth = frame.info().format.samples();
    let mut histograms = vec![[0_u64; 256]; depth];
    for pixel in frame.bytes().chunks_exact(depth) {
        for (histogram, &number) in histograms.iter_mut().zip(pixel) {
            histogram[usize::from(number)] += 1;
        }
    }
    let total: u64 = histograms[0].iter().sum::<u64>().max(1);
    let mean = |histogram: &[u64; 256]| {
        let sum: u64 = histogram
            .iter()
            .zip(0_u64..)
            .map(|(count, level)| count * level)
            .sum();
        share(sum, total * 255)
    };
    let counted = |level: usize| {
        histograms
            .iter()
            .map(|histogram| histogram[level])
            .sum::<u64>()
    };
    let distance = reference
        .filter(|reference| reference.info() == frame.info())
        .map(|reference| {
            let pairs = frame.bytes().iter().zip(reference.bytes());
            let sum: u64 = pairs
                .map(|(seen, still)| u64::from(seen.abs_diff(*still)))
                .sum();
            share(sum, total * depth as u64 * 255)
        });
    FrameFacts {
        mean: std::array::from_fn(|colour| mean(&histograms[colour.min(depth - 1)])),
        full: share(counted(255), total * depth as u64),
        zero: share(counted(0), total * depth as u64),
        is_flat: histograms.iter().all(|histogram| {
            let levels = histogram.iter().filter(|count| **count > 0);
            levels.count() == 1
        }),
        distance,
        tiles: Tiles::default(),
    }
}

fn facts_of_samples(frame: &Frame, reference: Option<&Frame>, format: PixelFormat) -> FrameFacts {
    let (depth, top) = (format.samples(), format.full_scale());
    let (mut sums, mut full, mut zero, mut count) = ([0_u64; 3], 0, 0, 0_u64);
    for (position, number) in frame.samples().enumerate() {
        sums[position % depth] += u64::from(number);
        full += u64::from(number == top);
        zero += u64::from(number == 0);
        count += 1;
    }
    let pixel = frame.samples().take(depth).collect::<Vec<u16>>();
    let is_flat = frame
        .samples()
        .enumerate()
        .all(|(position, number)| pixel[position % depth] == number);
    let count = count.max(1);
    let scale = count * u64::from(top);
    let distance = reference
        .filter(|reference| reference.info() == frame.info())
        .map(|reference| {
            let pairs = frame.samples().zip(reference.samples());
            share(
                pairs
                    .map(|(seen, still)| u64::from(seen.abs_diff(still)))
                    .sum(),
                scale,
            )
        });
    FrameFacts {
        mean: std::array::from_fn(|colour| {
            share(sums[colour.min(depth - 1)] * depth as u64, scale)
        }),
        full: share(full, count),
        zero: share(zero, count),
        is_flat,
        distance,
        tiles: Tiles::default(),
    }
}

fn share(part: u64, whole: u64) -> f64 {
    part as f64 / whole as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::FrameInfo;

    fn frame(format: PixelFormat, bytes: Vec<u8>) -> Frame {
        Frame::new(
            FrameInfo {
                width: 2,
                height: 1,
                format,
            },
            bytes,
        )
        .expect("two pixels")
    }

    #[test]
    fn eight_and_sixteen_bit_pictures_of_the_same_scene_have_the_same_facts() {
        let low = frame(PixelFormat::Rgb8, vec![0, 51, 255, 0, 153, 255]);
        let wide = low
            .samples()
            .flat_map(|number| (number * 257).to_le_bytes())
            .collect();
        let high = frame(PixelFormat::Rgb16, wide);
        let facts = FrameFacts::of(&low, Some(&low));
        assert_eq!(facts, FrameFacts::of(&high, Some(&high)));
        assert_eq!(
            facts.mean.map(f64::to_bits),
            [0.0, 0.4, 1.0].map(f64::to_bits)
        );
        assert_eq!(
            (facts.full, facts.zero, facts.distance),
            (2.0 / 6.0, 2.0 / 6.0, Some(0.0))
        );
    }

    #[test]
    fn gray_is_three_times_the_same() {
        let facts = FrameFacts::of(&frame(PixelFormat::Gray8, vec![0, 102]), None);
        assert_eq!((facts.mean, facts.distance), ([0.2; 3], None));
    }
}
