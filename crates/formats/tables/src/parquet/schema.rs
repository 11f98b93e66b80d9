//! Schema of a Parquet file as a tree of columns: structures, lists and leaves, with their levels.

use parquet::basic::{ConvertedType, LogicalType, Repetition, TimeUnit};
use parquet::schema::types::{SchemaDescriptor, Type};

use super::kind::ColumnKind;
use crate::limits;

/// Column, or part of a column.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) name: String,
    /// Minimum definition level at which this part is not null.
    pub(crate) definition: i16,
    pub(crate) kind: NodeKind,
}

#[derive(Clone, Debug)]
pub(crate) enum NodeKind {
    Leaf {
        column: usize,
        form: LeafForm,
        kind: ColumnKind,
    },
    Struct(Vec<Node>),
    List {
        /// Minimum definition level at which an element exists. `repetition` is the repetition level of all elements except the first.
        definition: i16,
        repetition: i16,
        element: Box<Node>,
    },
}

/// Logical type of a leaf of a Parquet schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LeafForm {
    /// No logical type: the cell has the physical type.
    Plain,
    Text,
    Unsigned,
    /// An integer divided by a power of ten.
    Decimal {
        scale: i32,
    },
    Half,
    /// A time or a date as an integer, in this unit.
    Time(&'static str),
}

/// Top-level columns of a Parquet schema. The error names the unsupported part.
pub(crate) fn columns(schema: &SchemaDescriptor) -> Result<Vec<Node>, String> {
    let mut leaves = 0;
    let nodes = schema
        .root_schema()
        .get_fields()
        .iter()
        .map(|field| node(field, Levels::default(), &mut leaves, 0))
        .collect::<Result<Vec<Node>, String>>()?;
    match leaves == schema.num_columns() {
        true => Ok(nodes),
        false => Err(format!(
            "{leaves} leaves in the schema, but {} columns",
            schema.num_columns()
        )),
    }
}

#[derive(Clone, Copy, Default)]
struct Levels {
    definition: i16,
    repetition: i16,
}

fn node(field: &Type, above: Levels, leaves: &mut usize, depth: usize) -> Result<Node, String> {
    let name = field.name();
    if depth > limits::DEPTH {
        return Err(format!(
            "`{name}` nests deeper than {} levels",
            limits::DEPTH
        ));
    }
    let info = field.get_basic_info();
    let repetition = match info.has_repetition() {
        true => info.repetition(),
        false => Repetition::REQUIRED,
    };
    if repetition == Repetition::REPEATED {
        // A repeated field without a list annotation is a list that is never null.
        let levels = deeper(above, true)?;
        let element = content(field, levels, leaves, depth)?;
        return Ok(Node {
            name: name.to_owned(),
            definition: above.definition,
            kind: NodeKind::List {
                definition: levels.definition,
                repetition: levels.repetition,
                element: Box::new(element),
            },
        });
    }
    let levels = match repetition {
        Repetition::OPTIONAL => Levels {
            definition: above.definition + 1,
            ..above
        },
        _ => above,
    };
    content(field, levels, leaves, depth)
}

/// Levels inside a field that lies at the levels `above`. A repeated field is one level deeper in both.
fn deeper(above: Levels, is_repeated: bool) -> Result<Levels, String> {
    let step = i16::from(is_repeated);
    let more = |level: i16| {
        level
            .checked_add(step)
            .ok_or("the schema has too many levels")
    };
    Ok(Levels {
        definition: more(above.definition)?,
        repetition: more(above.repetition)?,
    })
}

/// Builds the node of a field from its content. `levels` includes the repetition of the field itself.
fn content(field: &Type, levels: Levels, leaves: &mut usize, depth: usize) -> Result<Node, String> {
    let name = field.name().to_owned();
    let definition = levels.definition;
    if field.is_primitive() {
        let column = *leaves;
        *leaves += 1;
        let form = leaf_form(field)?;
        return Ok(Node {
            name,
            definition,
            kind: NodeKind::Leaf {
                column,
                form,
                kind: ColumnKind::of_leaf(field.get_physical_type(), form),
            },
        });
    }
    let fields = field.get_fields();
    if let ([only], true) = (fields, is_list(field)) {
        let info = only.get_basic_info();
        if info.has_repetition() && info.repetition() == Repetition::REPEATED {
            let inner = deeper(levels, true)?;
            let element = element(field, only, inner, leaves, depth + 1)?;
            return Ok(Node {
                name,
                definition,
                kind: NodeKind::List {
                    definition: inner.definition,
                    repetition: inner.repetition,
                    element: Box::new(element),
                },
            });
        }
    }
    let members = fields
        .iter()
        .map(|member| node(member, levels, leaves, depth + 1))
        .collect::<Result<Vec<Node>, String>>()?;
    match members.is_empty() {
        true => Err(format!("the structure `{name}` has no members")),
        false => Ok(Node {
            name,
            definition,
            kind: NodeKind::Struct(members),
        }),
    }
}

/// Builds the node of the elements of a list. `repeated` is the repeated group of the list.
///
/// The element is the only field of the group. The group itself is the element if it has several fields, or a name that older writers give to
/// elements.
fn element(
    list: &Type,
    repeated: &Type,
    levels: Levels,
    leaves: &mut usize,
    depth: usize,
) -> Result<Node, String> {
    let name = repeated.name();
    let is_element = repeated.is_primitive()
        || repeated.get_fields().len() != 1
        || name == "array"
        || name == format!("{}_tuple", list.name());
    match (
        is_element,
        repeated.is_group().then(|| repeated.get_fields()),
    ) {
        (false, Some([only])) => node(only, levels, leaves, depth + 1),
        _ => content(repeated, levels, leaves, depth + 1),
    }
}

fn is_list(field: &Type) -> bool {
    let info = field.get_basic_info();
    matches!(
        info.logical_type_ref(),
        Some(LogicalType::List | LogicalType::Map)
    ) || matches!(
        info.converted_type(),
        ConvertedType::LIST | ConvertedType::MAP | ConvertedType::MAP_KEY_VALUE
    )
}

fn leaf_form(field: &Type) -> Result<LeafForm, String> {
    let info = field.get_basic_info();
    let unit = |unit: &TimeUnit| match unit {
        TimeUnit::MILLIS => "ms",
        TimeUnit::MICROS => "us",
        TimeUnit::NANOS => "ns",
    };
    let decimal = |scale: i32| match (0..=38).contains(&scale) {
        true => Ok(LeafForm::Decimal { scale }),
        false => Err(format!("`{}` has {scale} decimals", field.name())),
    };
    if let Some(logical) = info.logical_type_ref() {
        return Ok(match logical {
            LogicalType::String | LogicalType::Enum | LogicalType::Json => LeafForm::Text,
            LogicalType::Integer(integer) if !integer.is_signed => LeafForm::Unsigned,
            LogicalType::Decimal(number) => decimal(number.scale)?,
            LogicalType::Float16 => LeafForm::Half,
            LogicalType::Date => LeafForm::Time("d"),
            LogicalType::Time(time) => LeafForm::Time(unit(&time.unit)),
            LogicalType::Timestamp(time) => LeafForm::Time(unit(&time.unit)),
            _ => LeafForm::Plain,
        });
    }
    Ok(match info.converted_type() {
        ConvertedType::UTF8 | ConvertedType::ENUM | ConvertedType::JSON => LeafForm::Text,
        ConvertedType::UINT_8
        | ConvertedType::UINT_16
        | ConvertedType::UINT_32
        | ConvertedType::UINT_64 => LeafForm::Unsigned,
        ConvertedType::DATE => LeafForm::Time("d"),
        ConvertedType::TIME_MILLIS | ConvertedType::TIMESTAMP_MILLIS => LeafForm::Time("ms"),
        ConvertedType::TIME_MICROS | ConvertedType::TIMESTAMP_MICROS => LeafForm::Time("us"),
        ConvertedType::DECIMAL => match field {
            Type::PrimitiveType { scale, .. } => decimal(*scale)?,
            _ => LeafForm::Plain,
        },
        _ => LeafForm::Plain,
    })
}
