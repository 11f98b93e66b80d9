//! Pictures of ball presses from a folder.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use taceva_sim::displacement::Load;

/// Radius of the ball, mm, as stated by the data set; the next constant is the side of a pixel.
const BALL_MM: f64 = 2.92;
const PIXEL_MM: f64 = 0.059_259_3;

/// A square picture in DN, with red, green and blue of each pixel side by side.
#[derive(Clone)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) dn: Vec<f64>,
}

/// Columns and rows of a part of a picture.
pub(crate) type Window = [Range<usize>; 2];

/// Press of the ball: its picture and its contact.
pub(crate) struct Press {
    pub(crate) picture: Picture,
    /// Centre and radius of the contact, pixels from the upper left corner.
    contact_px: [f64; 3],
}

/// All presses, and the picture of the untouched gel.
pub(crate) struct Presses {
    pub(crate) background: Picture,
    pub(crate) presses: Vec<Press>,
}

impl Picture {
    fn read(path: &Path) -> Result<Picture, Box<dyn Error>> {
        let image = image::open(path)?.to_rgb8();
        Ok(Picture {
            width: usize::try_from(image.width())?,
            dn: image.into_raw().into_iter().map(f64::from).collect(),
        })
    }

    pub(crate) fn height(&self) -> usize {
        self.dn.len() / (3 * self.width)
    }

    /// Copy of this picture with `change` added, DN, clipped to 8 bits.
    pub(crate) fn changed(&self, change: &[f64]) -> Picture {
        let changed = self.dn.iter().zip(change);
        Picture {
            width: self.width,
            dn: changed
                .map(|(dn, change)| (dn + change).clamp(0.0, 255.0))
                .collect(),
        }
    }

    /// Part of the picture within `columns` and `rows`.
    pub(crate) fn cut(&self, [columns, rows]: &Window) -> Picture {
        let row =
            |row: usize| &self.dn[3 * (row * self.width + columns.start)..][..3 * columns.len()];
        Picture {
            width: columns.len(),
            dn: rows.clone().flat_map(row).copied().collect(),
        }
    }
}

impl Presses {
    /// Reads the untouched gel and the ball presses that `labels.csv` in `folder` names.
    pub(crate) fn read(folder: &Path) -> Result<Presses, Box<dyn Error>> {
        let labels = folder.join("labels.csv");
        let text = std::fs::read_to_string(&labels)
            .map_err(|error| format!("{}: {error}", labels.display()))?;
        let (mut background, mut presses) = (None, Vec::new());
        for line in text.lines().skip(1) {
            let cells: Vec<&str> = line.split(',').collect();
            match cells[..] {
                [file, "background", ..] => background = Some(Picture::read(&folder.join(file))?),
                [file, "ball_calib", _, x, y, radius, ..] => presses.push(Press {
                    picture: Picture::read(&folder.join(file))?,
                    contact_px: [x.parse()?, y.parse()?, radius.parse()?],
                }),
                _ => {}
            }
        }
        let background = background.ok_or("no picture of the untouched gel")?;
        let is_alike = |press: &Press| {
            press.picture.width == background.width && press.picture.dn.len() == background.dn.len()
        };
        if presses.len() < 2 || !presses.iter().all(is_alike) {
            return Err("expected two or more presses, with pictures of one size".into());
        }
        Ok(Presses {
            background,
            presses,
        })
    }

    /// Width and height of the imaged area.
    pub(crate) fn field_mm(&self) -> [f64; 2] {
        [self.background.width, self.background.height()].map(|pixels| pixels as f64 * PIXEL_MM)
    }

    /// Picture of the press minus the picture of the untouched gel, DN, three colours per pixel.
    pub(crate) fn change(&self, press: &Press) -> Vec<f64> {
        let pairs = press.picture.dn.iter().zip(&self.background.dn);
        pairs
            .map(|(pressed, untouched)| pressed - untouched)
            .collect()
    }

    /// Place on the gel at pixel `column`, `row`: x to the right, y upwards, from the centre.
    pub(crate) fn place_mm(&self, column: f64, row: f64) -> [f64; 2] {
        let [width, height] = self.field_mm();
        [
            (column + 0.5) * PIXEL_MM - 0.5 * width,
            0.5 * height - (row + 0.5) * PIXEL_MM,
        ]
    }

    /// Contact in the terms of the bench: the annotated radius a, the depth a²/R for the ball radius R, and Hertz's force at a modulus of 1 MPa.
    pub(crate) fn load(&self, press: &Press) -> Load {
        let [column, row, radius] = press.contact_px;
        let contact_radius_mm = radius * PIXEL_MM;
        let depth_mm = contact_radius_mm * contact_radius_mm / BALL_MM;
        let reduced_mpa = taceva_sim::elastic::hertz::reduced_modulus(1.0, 0.5);
        Load {
            centre_mm: self.place_mm(column, row),
            contact_radius_mm,
            depth_mm,
            indenter_radius_mm: BALL_MM,
            young_modulus_mpa: 1.0,
            normal_force_n: taceva_sim::elastic::hertz::force(reduced_mpa, BALL_MM, depth_mm),
            ..Load::default()
        }
    }
}

impl Press {
    /// Window of two contact radii to each side of the contact, clipped to the picture.
    pub(crate) fn surroundings(&self) -> Window {
        let [column, row, radius] = self.contact_px;
        let around = |middle: f64, end: usize| {
            let pixel = |place: f64| (0..end).find(|pixel| *pixel as f64 >= place);
            pixel(middle - 2.0 * radius).unwrap_or(0)..pixel(middle + 2.0 * radius).unwrap_or(end)
        };
        [
            around(column, self.picture.width),
            around(row, self.picture.height()),
        ]
    }
}
