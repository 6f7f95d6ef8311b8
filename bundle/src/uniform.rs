//! A module whose functions say the same by the same bytes, for compressors: the variables of a function are
//! numbered by how often they are used, so what is done with the first ones is the same in most functions, and
//! no access of memory says how its address is aligned. With `order.rs` behind it, this is a hundredth of the page.

use std::cmp::Reverse;

use wasm_encoder::reencode::{Error, Reencode, utils};
use wasm_encoder::{CodeSection, Function, Instruction, MemArg, Module};
use wasmparser::{BinaryReaderError, CompositeInnerType, FunctionBody, Operator, Parser, Payload, ValType};

/// The same module, with uniform functions.
pub fn uniform(wasm: &[u8]) -> Result<Vec<u8>, Error> {
    let parameters = parameters(wasm)?.into_iter();
    let mut module = Module::new();
    Uniform { parameters, numbers: Vec::new() }.parse_core_module(&mut module, Parser::new(0), wasm)?;
    Ok(module.finish())
}

/// How many parameters each function has.
fn parameters(wasm: &[u8]) -> Result<Vec<u32>, BinaryReaderError> {
    let (mut of_types, mut of_functions) = (Vec::new(), Vec::new());
    for payload in Parser::new(0).parse_all(wasm) {
        match payload? {
            Payload::TypeSection(section) => {
                for group in section {
                    of_types.extend(group?.into_types().map(|it| match it.composite_type.inner {
                        CompositeInnerType::Func(function) => function.params().len() as u32,
                        _ => 0,
                    }));
                }
            }
            Payload::FunctionSection(section) => {
                for of in section {
                    of_functions.push(of_types[of? as usize]);
                }
            }
            _ => {}
        }
    }
    Ok(of_functions)
}

struct Uniform {
    /// How many parameters the next functions have: these are variables, too, whose numbers stay.
    parameters: std::vec::IntoIter<u32>,
    /// The new numbers of the variables of the function that is written, by the old ones.
    numbers: Vec<u32>,
}

impl Reencode for Uniform {
    type Error = std::convert::Infallible;

    fn parse_function_body(&mut self, code: &mut CodeSection, body: FunctionBody) -> Result<(), Error> {
        let parameters = self.parameters.next().unwrap_or_default();
        self.numbers = (0..parameters).collect();
        let mut variables = Vec::new();
        for run in body.get_locals_reader()? {
            let (count, of) = run?;
            variables.extend((0..count).map(|_| of));
        }
        let mut uses = vec![0_usize; variables.len()];
        for operator in body.get_operators_reader()? {
            if let Some(number) = variable(&mut operator?)
                && let Some(own) = number.checked_sub(parameters)
            {
                uses[own as usize] += 1;
            }
        }
        // Those of one type stay together: they are declared as runs.
        let mut kinds: Vec<(ValType, Vec<usize>)> = Vec::new();
        for (own, of) in variables.iter().enumerate() {
            match kinds.iter_mut().find(|kind| kind.0 == *of) {
                Some(kind) => kind.1.push(own),
                None => kinds.push((*of, vec![own])),
            }
        }
        self.numbers.resize(parameters as usize + variables.len(), 0);
        let mut numbers = parameters..;
        let mut runs = Vec::new();
        for (of, mut kind) in kinds {
            kind.sort_by_key(|own| Reverse(uses[*own]));
            for (own, number) in kind.iter().zip(&mut numbers) {
                self.numbers[parameters as usize + own] = number;
            }
            runs.push((kind.len() as u32, self.val_type(of)?));
        }
        let mut function = Function::new(runs);
        let mut operators = body.get_operators_reader()?;
        while !operators.eof() {
            function.instruction(&self.parse_instruction(&mut operators)?);
        }
        code.function(&function);
        Ok(())
    }

    fn instruction<'a>(&mut self, mut operator: Operator<'a>) -> Result<Instruction<'a>, Error> {
        if let Some(number) = variable(&mut operator) {
            *number = self.numbers[*number as usize];
        }
        utils::instruction(self, operator)
    }

    /// What is said of the alignment is a hint, which the engines of browsers leave alone. Of the atomic accesses, which
    /// must say it, the page has none: nothing of it is shared between threads.
    fn mem_arg(&mut self, access: wasmparser::MemArg) -> Result<MemArg, Error> {
        Ok(MemArg { align: 0, ..utils::mem_arg(self, access)? })
    }
}

/// The variable that is read or written.
fn variable<'a>(operator: &'a mut Operator) -> Option<&'a mut u32> {
    match operator {
        Operator::LocalGet { local_index }
        | Operator::LocalSet { local_index }
        | Operator::LocalTee { local_index } => Some(local_index),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use wasm_encoder::{CodeSection, Function, FunctionSection, Module, TypeSection, ValType};
    use wasmparser::{Parser, Payload};

    use super::*;

    /// The variables and the operators of the only function of a module.
    fn function(wasm: &[u8]) -> (Vec<(u32, wasmparser::ValType)>, Vec<Operator<'_>>) {
        let body = Parser::new(0).parse_all(wasm).find_map(|payload| match payload {
            Ok(Payload::CodeSectionEntry(body)) => Some(body),
            _ => None,
        });
        let body = body.expect("a function");
        let runs = body.get_locals_reader().unwrap().into_iter().collect::<Result<_, _>>().unwrap();
        let operators = body.get_operators_reader().unwrap().into_iter().collect::<Result<_, _>>().unwrap();
        (runs, operators)
    }

    #[test]
    fn what_is_used_most_has_the_lowest_number_of_its_type() {
        use Instruction::{Drop, End, I32Add, I32Load, I64Const, LocalGet, LocalSet, LocalTee};
        let mut module = Module::new();
        let mut types = TypeSection::new();
        types.ty().function([ValType::I64, ValType::I32], [ValType::I32]);
        let mut functions = FunctionSection::new();
        functions.function(0);
        // 0 and 1 are parameters; 2 and 5 stand in different runs of the same type.
        let mut body = Function::new([(1, ValType::I32), (2, ValType::I64), (1, ValType::I32)]);
        for instruction in [
            I64Const(7),
            LocalSet(4),
            LocalGet(1),
            I32Load(MemArg { offset: 12, align: 2, memory_index: 0 }),
            LocalTee(2),
            LocalTee(5),
            LocalGet(5),
            I32Add,
            LocalGet(0),
            Drop,
            End,
        ] {
            body.instruction(&instruction);
        }
        let mut code = CodeSection::new();
        code.function(&body);
        module.section(&types).section(&functions).section(&code);

        let uniform = uniform(&module.finish()).unwrap();
        let (runs, operators) = function(&uniform);
        assert_eq!(runs, [(2, wasmparser::ValType::I32), (2, wasmparser::ValType::I64)]);
        let load = wasmparser::MemArg { align: 0, max_align: 2, offset: 12, memory: 0 };
        assert_eq!(
            operators,
            [
                Operator::I64Const { value: 7 },
                Operator::LocalSet { local_index: 4 },
                Operator::LocalGet { local_index: 1 },
                Operator::I32Load { memarg: load },
                Operator::LocalTee { local_index: 3 },
                Operator::LocalTee { local_index: 2 },
                Operator::LocalGet { local_index: 2 },
                Operator::I32Add,
                Operator::LocalGet { local_index: 0 },
                Operator::Drop,
                Operator::End,
            ]
        );
    }
}
