//! The reference of a telegram: what stands where.

use super::{Algorithm, Items, Part, Telegram, Walk, Walker};
use crate::field::Spec;

/// One field, list or group of a telegram's layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    pub spec: &'static Spec,
    /// How many groups and lists it lies in.
    pub depth: usize,
    /// Its first byte, counted from 0; `None` behind something whose length varies.
    pub offset: Option<usize>,
    pub size: Size,
    /// What the field chooses, for a selector: the function code's value and its choice.
    pub chosen: Option<(u64, &'static Spec)>,
}

/// How many bytes a row stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    Fixed(usize),
    /// So many for each item of a list.
    Each(usize),
    /// As many as there are.
    Rest,
    /// A group: its rows follow.
    Group,
    /// A list: the rows of one of its items follow.
    List,
}

impl Size {
    /// Whether it stands for the rows that follow.
    pub const fn is_around(self) -> bool {
        matches!(self, Self::Group | Self::List)
    }
}

/// The layout of `telegram`, a row for each field; a list is shown by one item.
pub fn guide(telegram: &mut dyn Telegram) -> Vec<Row> {
    let mut guide = Guide { rows: Vec::new(), depth: 0, offset: Some(0), repeats: false };
    // The guide never stops a walk.
    let _ = telegram.walk(&mut guide);
    guide.rows
}

struct Guide {
    rows: Vec<Row>,
    depth: usize,
    /// Where the next field begins, as long as that is the same in every such telegram.
    offset: Option<usize>,
    repeats: bool,
}

impl Guide {
    fn row(&mut self, spec: &'static Spec, size: Size, chosen: Option<(u64, &'static Spec)>) {
        self.rows.push(Row { spec, depth: self.depth, offset: self.offset, size, chosen });
    }

    fn fixed(&mut self, spec: &'static Spec, width: usize, chosen: Option<(u64, &'static Spec)>) {
        self.row(spec, if self.repeats { Size::Each(width) } else { Size::Fixed(width) }, chosen);
        self.offset = self.offset.map(|offset| offset + width);
    }

    fn group(&mut self, spec: &'static Spec, size: Size, part: impl FnOnce(&mut Self) -> Walk) -> Walk {
        self.row(spec, size, None);
        self.depth += 1;
        let walk = part(self);
        self.depth -= 1;
        walk
    }
}

impl Walker for Guide {
    fn number(&mut self, spec: &'static Spec, width: usize, _: &mut u64) -> Walk {
        self.fixed(spec, width, None);
        Ok(())
    }

    fn select(
        &mut self,
        spec: &'static Spec,
        width: usize,
        raw: &mut u64,
        choices: &dyn Fn(u64) -> &'static Spec,
    ) -> Walk {
        self.fixed(spec, width, Some((*raw, choices(*raw))));
        Ok(())
    }

    fn announce(&mut self, spec: &'static Spec, width: usize, _: usize, _: usize) -> Walk<usize> {
        self.fixed(spec, width, None);
        Ok(1)
    }

    fn derived(&mut self, spec: &'static Spec, width: usize, _: Option<u64>) -> Walk {
        self.fixed(spec, width, None);
        Ok(())
    }

    fn bytes(&mut self, spec: &'static Spec, _: &mut Vec<u8>, count: Option<usize>) -> Walk {
        // What is announced counts 1 here: only what does not vary counts more.
        if let Some(count) = count.filter(|count| *count > 1) {
            self.fixed(spec, count, None);
            return Ok(());
        }
        self.row(spec, Size::Rest, None);
        self.offset = None;
        Ok(())
    }

    fn items(
        &mut self,
        spec: &'static Spec,
        items: &mut dyn Items,
        _: Option<usize>,
        _: Option<u64>,
    ) -> Walk {
        items.resize(1);
        self.group(spec, Size::List, |guide| {
            let repeats = std::mem::replace(&mut guide.repeats, true);
            let walk = items.walk(0, guide);
            guide.repeats = repeats;
            guide.offset = None;
            walk
        })
    }

    fn within(&mut self, spec: &'static Spec, part: Part<'_>) -> Walk {
        self.group(spec, Size::Group, |guide| part(guide))
    }

    fn window(&mut self, _: usize, part: Part<'_>) -> Walk {
        part(self)
    }

    fn checksum(&mut self, spec: &'static Spec, algorithm: &'static Algorithm, _: usize) -> Walk {
        self.fixed(spec, algorithm.width, None);
        Ok(())
    }
}
