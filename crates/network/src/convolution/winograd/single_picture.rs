//! Forward pass of one picture, divided among threads.

use std::ops::Range;

use super::products::{Group, Products, stretch, tiles_at_once};
use super::tiles::{OutputBuffer, PictureValues};
use super::{POINTS, TILE, Tiles, slab};
use crate::convolution::division::{Division, Outputs};
use crate::convolution::ending::SumRule;
use crate::convolution::gathering::Gathering;
use crate::convolution::workspace::TileRooms;
use crate::machine::Machine;
use crate::panel::PANEL;
use crate::team;

/// One picture and its convolution, to be divided among threads.
#[derive(Clone, Copy)]
pub(super) struct Divided<'a> {
    pub(super) products: Products,
    pub(super) input: &'a [f32],
    /// Transformed weights.
    pub(super) weights: &'a [f32],
}

/// Work of one thread.
struct Part<'a> {
    tiles: Range<usize>,
    weights: &'a [f32],
    output: OutputBuffer<'a>,
    rule: SumRule<'a>,
}

impl Products {
    /// Size of the work for one picture, for its division among threads.
    pub(super) fn outputs(&self) -> Outputs {
        let tiles = Tiles::of(self.output.picture);
        Outputs {
            pixels: tiles.per_picture,
            // Parts are whole rows of tiles, which write whole rows of the output.
            together: tiles.across,
            panels: self.output.picture.channels / PANEL,
            products: self.input.picture.channels,
            points: POINTS,
        }
    }
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
            Division::Whole => self.by_rows(machine, 1, output, ending, rooms),
            Division::Pixels(parts) => self.by_rows(machine, parts, output, ending, rooms),
            Division::Panels(parts) => {
                let ending = ending(0..output.len());
                self.by_panels(machine, parts, output, ending, rooms);
            }
        }
    }

    /// Divides the work by rows of tiles.
    fn by_rows(
        self,
        machine: Machine,
        parts: usize,
        output: &mut [f32],
        ending: impl Fn(Range<usize>) -> SumRule<'a> + Sync,
        rooms: &TileRooms,
    ) {
        let layout = self.products.output;
        let tiles = Tiles::of(layout.picture);
        let all = tiles.per_picture / tiles.across;
        let share = all.div_ceil(parts);
        let length = output.len();
        let (mut rest, mut skipped) = (output, 0);
        let mut stretches = Vec::with_capacity(parts);
        for first in (0..all).step_by(share) {
            let last = (first + share).min(all);
            let end = if last == all {
                length
            } else {
                (last * TILE + layout.border) * layout.row()
            };
            let (stretch, others) = rest.split_at_mut(end - skipped);
            stretches.push(Part {
                tiles: first * tiles.across..last * tiles.across,
                weights: self.weights,
                output: OutputBuffer {
                    values: stretch,
                    layout,
                    skipped,
                },
                rule: ending(skipped..end),
            });
            (rest, skipped) = (others, end);
        }
        team::divide(stretches, |part| self.part(machine, part, rooms));
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
        let layout = self.products.output;
        let picture = layout.picture;
        let channels = (picture.channels / PANEL).div_ceil(parts) * PANEL;
        let of_panel = POINTS * slab(self.products.input.picture.channels, PANEL);
        rooms.with(picture.len(), |room| {
            let weights = self.weights.chunks(channels / PANEL * of_panel);
            let apart = room.chunks_mut(picture.pixels() * channels).enumerate();
            let parts = apart.zip(weights).map(|((part, output), weights)| {
                let mut layout = layout.bare();
                layout.picture.channels = output.len() / picture.pixels();
                Part {
                    tiles: 0..Tiles::of(picture).per_picture,
                    weights,
                    output: OutputBuffer {
                        values: output,
                        layout,
                        skipped: 0,
                    },
                    rule: rule.of_part(part * channels),
                }
            });
            team::divide(parts.collect(), |part| self.part(machine, part, rooms));
            machine.run(Gathering {
                parts: room,
                channels,
                output: (output, layout),
                finish: rule.finish,
            });
        });
    }

    fn part(self, machine: Machine, part: Part<'_>, rooms: &TileRooms) {
        let Products {
            input,
            output,
            channels_at_once,
        } = self.products;
        let channels = [input, part.output.layout].map(|layout| layout.picture.channels);
        let at_once = stretch(part.tiles.len(), tiles_at_once(part.weights));
        let slabs = channels.map(|channels| slab(at_once, channels));
        rooms.with(POINTS * (slabs[0] + slabs[1]), |room| {
            let (at_points, sums) = room.split_at_mut(POINTS * slabs[0]);
            machine.run(Group {
                tiles: Tiles::of(output.picture),
                range: part.tiles,
                at_once,
                channels,
                channels_at_once,
                pictures: PictureValues {
                    values: self.input,
                    layout: input,
                },
                weights: part.weights,
                output: part.output,
                rule: part.rule,
                room: [at_points, sums],
            });
        });
    }
}
