//! Forward pass of one picture, divided among threads.

use std::ops::Range;

use super::correlation::{Correlation, OutputLayout};
use super::forward::{Class, ROWS};
use crate::convolution::TileRooms;
use crate::convolution::division::Division;
use crate::convolution::ending::SumRule;
use crate::convolution::gathering::Gathering;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::planes::Layout;
use crate::team;

/// One picture and its convolution, to be divided among threads.
#[derive(Clone, Copy)]
pub(super) struct Divided<'a> {
    pub(super) class: &'a Class,
    /// Number of rows of weights in each panel.
    pub(super) rows: usize,
    pub(super) input: &'a [f32],
    pub(super) weights: &'a [f32],
    /// Memory layout of the output.
    pub(super) layout: Layout,
}

impl<'a> Divided<'a> {
    /// Computes and writes the output. `ending` returns the start values of the sums and the operation on finished sums, for a range of output
    /// values.
    pub(super) fn run(
        self,
        machine: Machine,
        division: Division,
        output: &mut [f32],
        ending: impl Fn(Range<usize>) -> SumRule<'a> + Sync,
        rooms: &TileRooms,
    ) {
        match division {
            Division::Whole => self.by_pixels(machine, 1, output, ending),
            Division::Pixels(parts) => self.by_pixels(machine, parts, output, ending),
            Division::Panels(parts) => {
                let ending = ending(0..output.len());
                self.by_panels(machine, parts, output, ending, rooms);
            }
        }
    }

    /// Divides the work by pixels. Each part writes one range of the output.
    fn by_pixels(
        self,
        machine: Machine,
        parts: usize,
        output: &mut [f32],
        ending: impl Fn(Range<usize>) -> SumRule<'a> + Sync,
    ) {
        let pixels = self.class.pixels.len();
        let share = pixels.div_ceil(parts).next_multiple_of(ROWS);
        let length = output.len();
        let (mut rest, mut skipped) = (output, 0);
        let mut stretches = Vec::with_capacity(parts);
        for first in (0..pixels).step_by(share) {
            let range = first..(first + share).min(pixels);
            let end = if range.end == pixels {
                length
            } else {
                self.class.pixels.at(range.end).1
            };
            let (stretch, others) = rest.split_at_mut(end - skipped);
            stretches.push((range, skipped, stretch));
            (rest, skipped) = (others, end);
        }
        team::divide(stretches, |(range, skipped, output)| {
            let ending = ending(skipped..skipped + output.len());
            let image = length;
            let layout = OutputLayout::Pictures { image, skipped };
            self.part(machine, range, self.weights, output, layout, ending);
        });
    }

    /// Divides the work by panels of output channels. Each part writes to its own buffer, and the buffers are then gathered.
    fn by_panels(
        self,
        machine: Machine,
        parts: usize,
        output: &mut [f32],
        rule: SumRule<'a>,
        rooms: &TileRooms,
    ) {
        let picture = self.layout.picture;
        let channels = (picture.channels / PANEL).div_ceil(parts) * PANEL;
        rooms.with(picture.len(), |room| {
            let weights = self.weights.chunks(self.rows * channels);
            let apart = room.chunks_mut(picture.pixels() * channels);
            let parts = apart.zip(weights).enumerate().collect();
            team::divide(parts, |(part, (output, weights))| {
                let layout = OutputLayout::Packed {
                    channels: output.len() / picture.pixels(),
                };
                let ending = rule.of_part(part * channels);
                let range = 0..self.class.pixels.len();
                self.part(machine, range, weights, output, layout, ending);
            });
            machine.run(Gathering {
                parts: room,
                channels,
                output: (output, self.layout),
                finish: rule.finish,
            });
        });
    }

    fn part(
        self,
        machine: Machine,
        range: Range<usize>,
        weights: &[f32],
        output: &mut [f32],
        layout: OutputLayout,
        rule: SumRule<'_>,
    ) {
        machine.run(Correlation {
            pixels: &self.class.pixels,
            range,
            input: self.input,
            // A single picture needs no stride.
            input_image: 0,
            taps: &self.class.taps,
            run: self.class.run,
            weights,
            rows: self.rows,
            output,
            layout,
            rule,
        });
    }
}
