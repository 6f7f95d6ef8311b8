use crate::field::{Argument, Name, Severity, Spec, hex_value};
use crate::message;
use crate::walk::{Walk, Walker};

/// A number that has one of two values, such as FF00h for on and 0000h for off.
#[derive(Debug)]
pub struct Choice {
    spec: Spec,
    width: usize,
    names: &'static [Name; 2],
    /// The names once more, as a selector wants them.
    options: [Spec; 2],
}

impl Choice {
    pub const fn new(spec: Spec, width: usize, names: &'static [Name; 2]) -> Self {
        let options = [Spec::new("option", names[0].label), Spec::new("option", names[1].label)];
        Self { spec: spec.names(names), width, names, options }
    }

    pub fn walk(&'static self, w: &mut dyn Walker, value: &mut u16) -> Walk {
        w.choose(&self.spec, self.width, value, &|raw| {
            let known = self.names.iter().position(|name| name.value == raw);
            known.and_then(|known| self.options.get(known)).unwrap_or(&UNDEFINED)
        })?;
        let raw = u64::from(*value);
        if self.spec.name(raw).is_none() {
            let [one, other] = self.names;
            w.remark(
                &self.spec,
                Severity::Error,
                "not-defined",
                message!(
                    "{label} is {raw}; there are only {one} ({one_name}) and {other} ({other_name})",
                    label = Argument::Term(self.spec.label),
                    raw = hex_value(raw, self.width),
                    one = hex_value(one.value, self.width),
                    one_name = Argument::Term(one.label),
                    other = hex_value(other.value, self.width),
                    other_name = Argument::Term(other.label)
                ),
            );
        }
        Ok(())
    }

    /// What `value` is called, if it is one of the two.
    pub fn name(&self, value: u16) -> Option<&'static str> {
        self.spec.name(value.into()).map(|name| name.label)
    }
}

static UNDEFINED: Spec = Spec::new("undefined", "not defined");
