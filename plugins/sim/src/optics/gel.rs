//! The gel in front of the camera, whichever it is.

use super::band::Band;
use super::error::OpticsError;
use super::gelsight::Gelsight;
use super::magictac::Magictac;
use super::raster::Raster;
use super::spec::GelSpec;
use super::view::View;
use super::vitactip::Vitactip;
use crate::random::Random;

/// One unit of a gel, seen at one frame size.
#[derive(Clone, Debug)]
pub(super) enum Gel {
    Gelsight(Box<Gelsight>),
    Magictac(Box<Magictac>),
    Vitactip(Box<Vitactip>),
}

impl Gel {
    pub(super) fn new(spec: &GelSpec, raster: Raster, unit: u32) -> Gel {
        match spec {
            GelSpec::Gelsight(spec) => Gel::Gelsight(Box::new(Gelsight::new(spec, raster, unit))),
            GelSpec::Magictac(spec) => Gel::Magictac(Box::new(Magictac::new(spec, raster, unit))),
            GelSpec::Vitactip(spec) => Gel::Vitactip(Box::new(Vitactip::new(spec, raster, unit))),
        }
    }

    /// Takes in what is touched, once a frame; `random` gives what happens to the gel by chance.
    pub(super) fn pose(&mut self, view: &View, random: &Random) -> Result<(), OpticsError> {
        match self {
            Gel::Gelsight(gel) => gel.pose(view),
            Gel::Magictac(gel) => gel.pose(view, random),
            Gel::Vitactip(gel) => gel.pose(view),
        }
    }

    /// Paints the light of some rows of the view last taken in.
    #[inline(always)]
    pub(super) fn paint(&self, band: &mut Band<'_>) {
        match self {
            Gel::Gelsight(gel) => gel.paint(band),
            Gel::Magictac(gel) => gel.paint(band),
            Gel::Vitactip(gel) => gel.paint(band),
        }
    }
}
