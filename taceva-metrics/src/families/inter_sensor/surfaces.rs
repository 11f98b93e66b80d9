//! Surfaces of units, given by the places of first contact.

use taceva_core::{Batch, Field};

use crate::evaluate::family::each_row;
use crate::exact::level::millionths;
use crate::exact::merge::{Merge, keyed};
use crate::exact::number_key::Ordered;
use crate::exact::record::Record;
use crate::exact::sorted_map::SortedMap;
use crate::exact::{Dyadic, ExactSum};
use crate::families::cells::{Cells, add_times};
use crate::geometry::Point;

/// Places of first contact, by contact point and sensor unit.
///
/// The places form a set: a place in several samples counts once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SurfaceClouds {
    n: u64,
    n_invalid: u64,
    cells: Cells<Places>,
}

/// Set of places in ascending order.
type PlaceSet = SortedMap<[Ordered; 3], ()>;

/// Places of one contact point, by unit.
#[derive(Clone, Debug, Default, PartialEq)]
struct Places {
    units: SortedMap<String, PlaceSet>,
}

/// Surface of one unit: its points in a fixed order, and the index of the contact point of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Cloud {
    /// Points of the surface, mm.
    pub(super) points: Vec<Point>,
    /// Index of each point's contact point, the same for all units. Empty if samples have no contact points.
    pub(super) locations: Vec<usize>,
}

impl SurfaceClouds {
    /// Adds the places of `rows` of `batch`. `axes` are the indices of the channels of x, y and z, mm. A place with an invalid coordinate only
    /// raises the count of skipped samples.
    pub(super) fn deposit(&mut self, batch: &Batch, axes: [usize; 3], rows: Option<&[u32]>) {
        let mut cells = self.cells.of_batch(batch);
        let Some(units) = batch.labels(Field::UnitId) else {
            return;
        };
        each_row(batch, rows, |row| {
            let [x, y, z] = axes.map(|axis| batch.truth(axis).get(row));
            let (Some(unit), Some(x), Some(y), Some(z)) = (units.get(row), x, y, z) else {
                return;
            };
            let place_mm: Point = [x, y, z];
            if !place_mm.iter().all(|length| millionths(*length).is_some()) {
                self.n_invalid += 1;
                return;
            }
            self.n += 1;
            let units = &mut cells.at(row, 0).units;
            if units.get(unit).is_none() {
                units.insert(unit.to_owned(), PlaceSet::default());
            }
            if let Some(places) = units.get_mut(unit) {
                places.insert(place_mm.map(Ordered::new), ());
            }
        });
    }

    /// Number of samples.
    pub(super) fn n(&self) -> u64 {
        self.n
    }

    /// Number of skipped samples.
    pub(super) fn n_invalid(&self) -> u64 {
        self.n_invalid
    }

    /// Surface of each unit as points. If samples have contact points, each contact point has one point: the mean of its places along each axis.
    /// Otherwise every place is a point.
    pub(super) fn by_unit(&self) -> Vec<(&str, Cloud)> {
        let mut clouds: SortedMap<&str, Cloud> = SortedMap::default();
        for (location, (_, cell)) in self.cells.iter().enumerate() {
            for (unit, places) in &cell.units {
                let cloud = clouds.entry(unit.as_str());
                if self.cells.are_named() {
                    cloud.points.push(mean_place(places));
                    cloud.locations.push(location);
                } else {
                    cloud
                        .points
                        .extend(places.iter().map(|(place, ())| place.map(Ordered::value)));
                }
            }
        }
        let clouds = clouds.iter().map(|(unit, cloud)| (*unit, cloud.clone()));
        clouds.collect()
    }

    /// Converts the surfaces to a record for a saved state: x, y and z of each place, by contact point and unit.
    pub(super) fn to_record(&self) -> Record {
        let cell = |cell: &Places| {
            let units = cell.units.iter().map(|(unit, places)| {
                let record = Record {
                    values: places
                        .iter()
                        .flat_map(|(place, ())| place.map(Ordered::value))
                        .collect(),
                    ..Record::default()
                };
                (unit.clone(), record)
            });
            Record {
                cells: keyed(units),
                ..Record::default()
            }
        };
        Record {
            counts: vec![self.n, self.n_invalid, u64::from(self.cells.are_named())],
            cells: self.cells.to_records(cell),
            ..Record::default()
        }
    }

    /// Reads the surfaces from a record of a saved state.
    pub(super) fn read_record(record: &Record) -> Result<SurfaceClouds, String> {
        let (&[n, n_invalid, named], []) = record.with_cells()?;
        let places = |record: &Record| {
            let lengths = record
                .values
                .iter()
                .all(|value| millionths(*value).is_some());
            let whole = lengths && record.values.len().is_multiple_of(3) && record.cells.is_empty();
            let triples = record.values.chunks_exact(3);
            let mut places = PlaceSet::default();
            for place in triples {
                places.insert([place[0], place[1], place[2]].map(Ordered::new), ());
            }
            let found = whole.then_some(places).filter(|places| !places.is_empty());
            found.ok_or_else(|| {
                "invalid places of a surface, expected places of three lengths each".to_owned()
            })
        };
        let cell = |record: &Record| {
            let ([], []) = record.with_cells()?;
            let units = record.read_cells(|unit| Some(unit.to_owned()), places)?;
            Ok(Places { units })
        };
        Ok(SurfaceClouds {
            n,
            n_invalid,
            cells: Cells::from_record(record, named == 1, cell)?,
        })
    }
}

impl Merge for SurfaceClouds {
    fn merge(&mut self, other: &SurfaceClouds) {
        self.merge_times(other, 1);
    }

    fn merge_times(&mut self, other: &SurfaceClouds, times: u32) {
        add_times(&mut self.n, other.n, times);
        add_times(&mut self.n_invalid, other.n_invalid, times);
        self.cells.merge_times(&other.cells, times);
    }
}

impl Merge for Places {
    fn merge(&mut self, other: &Places) {
        for (unit, places) in &other.units {
            let ours = self.units.entry(unit.clone());
            for (place, ()) in places {
                ours.insert(*place, ());
            }
        }
    }
}

/// Mean of the places along each axis, rounded once.
fn mean_place(places: &PlaceSet) -> Point {
    let count = places.iter().fold(0, |count, _| count + 1);
    std::array::from_fn(|axis| {
        let sum: ExactSum = places
            .iter()
            .map(|(place, ())| place[axis].value())
            .collect();
        sum.to_dyadic().over(&Dyadic::from(count))
    })
}
