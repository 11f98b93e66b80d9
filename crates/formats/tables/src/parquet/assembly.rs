//! Assembly of the rows of a Parquet column from its leaf columns. The levels of an entry tell if a list begins, continues, is empty or is missing.

use parquet::file::metadata::RowGroupMetaData;

use super::leaf::Leaf;
use super::schema::{Node, NodeKind};
use crate::cell::Cell;
use crate::error::{Place, TableError};
use crate::source::Source;

/// Column in one row group: the tree of its schema, with a reader at each leaf.
pub(super) struct Assembly {
    root: Part,
}

struct Part {
    definition: i16,
    kind: PartKind,
}

enum PartKind {
    Leaf(Box<Leaf>),
    Struct(Vec<(String, Part)>),
    List {
        definition: i16,
        repetition: i16,
        element: Box<Part>,
    },
}

impl Assembly {
    /// Creates the readers of the column `node` in the row group `group`.
    pub(super) fn new(
        source: &Source,
        group: &RowGroupMetaData,
        node: &Node,
    ) -> Result<Assembly, TableError> {
        Ok(Assembly {
            root: Part::new(source, group, node)?,
        })
    }

    /// Calls `each` with the cell of each of the next `rows` rows.
    pub(super) fn read(
        &mut self,
        source: &Source,
        rows: usize,
        each: &mut impl FnMut(Cell) -> Result<(), TableError>,
    ) -> Result<(), TableError> {
        self.root.for_each_leaf(&mut |leaf| leaf.read(rows))?;
        for _ in 0..rows {
            each(self.root.row()?)?;
            // A row that ends inside a list would shift all later rows.
            if self
                .root
                .first()
                .peek()
                .is_some_and(|(_, repetition)| repetition != 0)
            {
                return Err(source.damaged(Place::default(), "there are entries outside any list"));
            }
        }
        Ok(())
    }

    pub(super) fn skip(&mut self, rows: usize) -> Result<(), TableError> {
        self.root.for_each_leaf(&mut |leaf| leaf.skip(rows))
    }
}

impl Part {
    fn new(source: &Source, group: &RowGroupMetaData, node: &Node) -> Result<Part, TableError> {
        let kind = match &node.kind {
            NodeKind::Leaf { column, form, .. } => {
                PartKind::Leaf(Box::new(Leaf::new(source, group, *column, *form)?))
            }
            NodeKind::Struct(members) => PartKind::Struct(
                members
                    .iter()
                    .map(|member| Ok((member.name.clone(), Part::new(source, group, member)?)))
                    .collect::<Result<_, TableError>>()?,
            ),
            NodeKind::List {
                definition,
                repetition,
                element,
            } => PartKind::List {
                definition: *definition,
                repetition: *repetition,
                element: Box::new(Part::new(source, group, element)?),
            },
        };
        Ok(Part {
            definition: node.definition,
            kind,
        })
    }

    fn for_each_leaf(
        &mut self,
        each: &mut impl FnMut(&mut Leaf) -> Result<(), TableError>,
    ) -> Result<(), TableError> {
        match &mut self.kind {
            PartKind::Leaf(leaf) => each(leaf),
            PartKind::Struct(members) => members
                .iter_mut()
                .try_for_each(|(_, member)| member.for_each_leaf(each)),
            PartKind::List { element, .. } => element.for_each_leaf(each),
        }
    }

    /// First leaf below this part. The levels of all leaves below a part are equal as far as they concern the part.
    fn first(&self) -> &Leaf {
        match &self.kind {
            PartKind::Leaf(leaf) => leaf,
            PartKind::Struct(members) => {
                members.first().expect("structures have members").1.first()
            }
            PartKind::List { element, .. } => element.first(),
        }
    }

    /// Takes the cell of the next row, or of the next element of the enclosing list.
    fn row(&mut self) -> Result<Cell, TableError> {
        let next = self.first().peek();
        let definition = next.map_or(0, |(definition, _)| definition);
        if let PartKind::Leaf(leaf) = &mut self.kind {
            return leaf.take();
        }
        if definition < self.definition {
            return self.drop_entry().map(|()| Cell::Null);
        }
        match &mut self.kind {
            PartKind::Leaf(leaf) => leaf.take(),
            PartKind::Struct(members) => members
                .iter_mut()
                .map(|(name, member)| Ok((name.clone(), member.row()?)))
                .collect::<Result<_, TableError>>()
                .map(Cell::Struct),
            PartKind::List {
                definition: level, ..
            } if definition < *level => self.drop_entry().map(|()| Cell::List(Vec::new())),
            PartKind::List {
                repetition,
                element,
                ..
            } => {
                let mut cells = vec![element.row()?];
                while element
                    .first()
                    .peek()
                    .is_some_and(|(_, level)| level == *repetition)
                {
                    cells.push(element.row()?);
                }
                Ok(Cell::List(cells))
            }
        }
    }

    /// Consumes the null entry of each leaf.
    fn drop_entry(&mut self) -> Result<(), TableError> {
        self.for_each_leaf(&mut |leaf| leaf.take().map(drop))
    }
}
