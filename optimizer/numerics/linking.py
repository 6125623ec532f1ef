"""What only kernels call is linked into them, and not made machine code of on its own.

Numba optimises every function for itself, makes machine code of it, and optimises it again in all that it is linked
into. Of most of ours nobody asks for machine code, so both wait until somebody does: a sixth of the time to compile.
Before linking functions take the first level alone: a higher one does its work once, after linking.
Another sixth is saved as loops are put into lanes, but not written out several times: webs, rows and coefficients are
few.
"""

from typing import Any

from llvmlite.binding import PassBuilder, create_pass_builder, create_pipeline_tuning_options
from numba import config
from numba.core.registry import cpu_target

from optimizer.numerics.loading import Library


class _Linked(Library):
    """A function and all that it calls, optimised at the first request for its machine code."""

    _is_final = False

    def _optimize_functions(self, module: Any) -> None:
        # by passes that are put together once, and not those that are only named here
        module.data_layout = self._codegen._data_layout  # noqa: SLF001
        passes, builder = self._codegen._function_pass_manager()  # noqa: SLF001
        for function in module.functions:
            if not function.is_declaration:
                passes.run(function, builder)

    def _optimize_final_module(self) -> None:
        """Later, or never."""

    def _set_compiled_object(self, value: bytes) -> None:
        self._is_final = True
        super()._set_compiled_object(value)

    def _finalize_final_module(self) -> None:
        if self._is_final:
            super()._finalize_final_module()
        else:
            self._finalize_dynamic_globals()
            self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        self._ensure_finalized()
        if not self._is_final and name in {function.name for function in self.get_defined_functions()}:
            # other kernels are linked with it as it was: loops that are written out would be written out once more
            self._get_module_for_linking()
            self._is_final = True
            super()._optimize_final_module()
            self._final_module.verify()
            self._finalize_final_module()
        return int(super().get_pointer_to_function(name))


def link_first() -> None:
    """From now on, in this process."""
    codegen = cpu_target.target_context.codegen()

    def short_loops(
        opt: int = config.OPT, loop_vectorize: int = config.LOOP_VECTORIZE, slp_vectorize: int = config.SLP_VECTORIZE
    ) -> PassBuilder:
        options = create_pipeline_tuning_options(opt)
        options.loop_vectorization, options.slp_vectorization = loop_vectorize, slp_vectorize
        options.loop_unrolling = options.loop_interleaving = False
        return create_pass_builder(codegen._tm, options)  # noqa: SLF001

    def first_passes() -> tuple[Any, PassBuilder]:
        # all is optimised once more where it is linked
        builder = short_loops(opt=1)
        passes = builder.getFunctionPassManager()
        passes.add_refprune_pass()
        return passes, builder

    # numba has no options for these
    codegen._library_class, codegen._pass_builder = _Linked, short_loops  # noqa: SLF001
    codegen._function_pass_manager = first_passes  # noqa: SLF001
    set_env = codegen.set_env

    def set_where_present(name: str, env: Any) -> None:
        # what is not machine code has no place for its environment, and nobody to look there
        if codegen._engine.get_global_value_address(name):  # noqa: SLF001
            set_env(name, env)

    codegen.set_env = set_where_present
