"""The verification plan as data: what each unit promises, which tests show it, which cover points it needs.

Promises stand beside what they concern (`plan.toml`), the specification's rules and faults in
`specification.toml`. Reading and checking need no simulator.
"""
